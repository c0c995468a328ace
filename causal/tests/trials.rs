//! Files of trials as text go in, and what becomes of them is held: which states they get, what is refused, and where.

use std::io::Read;
use std::sync::Arc;

use causal::count::Counter;
use causal::discretize::{declare, discretize};
use causal::place::{Policy, Unfit};
use causal::recipe::{Cuts, Declared, Recipe};
use causal::source::csv::{self, Csv};
use causal::source::parquet::{Open, Parquet};
use causal::source::{Fault, Source};
use causal::stream::{self, Stream};
use causal::survey::survey;
use causal::table::Table;
use causal::variable::{Variable, VariableId};

/// Files of CSV, each with its name.
fn files(texts: &[(&str, &str)]) -> Result<Csv, Fault> {
    let files = texts.iter().map(|(name, text)| {
        let text: Arc<[u8]> = text.as_bytes().into();
        let open: csv::Open = Box::new(move || {
            Ok(Box::new(std::io::Cursor::new(text.clone())) as Box<dyn Read + Send>)
        });
        ((*name).to_owned(), open)
    });
    Csv::new(files.collect())
}

fn csv(text: &str) -> Csv {
    files(&[("trials.csv", text)]).unwrap()
}

fn cut(source: &dyn Source, declared: &[Declared]) -> Result<(Vec<Variable>, Vec<String>), Fault> {
    let survey = survey(source, declared)?;
    let found = discretize(source, declared, &survey, None)?;
    Ok((found.variables, found.notes))
}

fn load(source: &dyn Source) -> Result<Table, Fault> {
    let (variables, _) = cut(source, &declare(source))?;
    Ok(stream::table(source, &variables, Policy::default())?.0)
}

/// Trials with a quantity, a word and a whole number.
fn some_trials(rows: usize) -> String {
    let mut lines = vec!["xOff,colour,onTop".to_owned()];
    for row in 0..rows {
        let colour = ["red", "blue", "green"][row * 7 % 3];
        lines.push(format!("{},{colour},{}", (row * 37 % 100) as f64 / 10.0 - 5.0, row % 2));
    }
    lines.join("\n")
}

#[test]
fn quantities_become_quantiles_and_words_categories() {
    let table = load(&csv(&some_trials(1000))).unwrap();
    let labels: Vec<Vec<String>> = table.variables().iter().map(Variable::labels).collect();
    assert_eq!(labels[0], ["[-5, -3)", "[-3, -1)", "[-1, 1)", "[1, 3)", "[3, 4.9]"]);
    assert_eq!(labels[1], ["blue", "green", "red"]);
    assert_eq!(labels[2], ["0", "1"]);
    let counts = table.count(&[vec![VariableId(0)]]).unwrap();
    assert_eq!(counts, [[200; 5]], "quantiles hold as many trials each");
}

#[test]
fn shards_and_streams_count_as_a_table_does() {
    let text = some_trials(1000);
    let whole = csv(&text);
    let lines: Vec<&str> = text.lines().collect();
    let one = format!("{}\n{}\n", lines[0], lines[1..400].join("\n"));
    // The second file has its columns in another order.
    let turned: Vec<String> = lines[400..]
        .iter()
        .map(|line| line.split(',').rev().collect::<Vec<_>>().join(","))
        .collect();
    let two = format!("onTop,colour,xOff\n{}\n", turned.join("\n"));
    let shards = files(&[("1.csv", &one), ("2.csv", &two)]).unwrap();
    let table = load(&whole).unwrap();
    let stream = Stream::new(&shards, table.variables(), Policy::default()).unwrap();
    let sets: Vec<Vec<VariableId>> = [&[0, 1, 2][..], &[2, 0], &[1], &[]]
        .map(|set| set.iter().map(|&id| VariableId(id)).collect())
        .into();
    assert_eq!(stream.count(&sets).unwrap(), table.count(&sets).unwrap());
    assert_eq!(
        (stream.rows(), stream.readings()),
        (1000, 2),
        "once for the rows, once for all sets"
    );
}

#[test]
fn declared_variables_are_made_of_columns() {
    let recipe = Recipe::read(
        r#"{"caveat-recipe": 1, "variables": [
            {"name": "far", "unit": "m", "from": {"norm": ["x", "y"]}, "cuts": {"edges": [0, 2, 6]}},
            {"name": "course", "from": {"relative": "way"}, "cuts": {"k-means": 2}},
            {"name": "moved", "from": {"total-variation": "way"}, "cuts": {"width": 2}},
            {"name": "good", "role": "outcome", "from": {"threshold": {"of": "rating", "at-least": 4}}}]}"#,
    )
    .unwrap();
    let source = csv("x,y,way[0],way[1],way[2],rating\n\
         3,4,1,2,3,5\n0,1,5,6,7,4\n1,1,9,9,9,1\n0,0,2,2,2.5,3\n");
    let (variables, _) = cut(&source, &recipe.variables).unwrap();
    let (table, _) = stream::table(&source, &variables, Policy::default()).unwrap();
    let states: Vec<Vec<u8>> = table.ids().map(|id| table.column(id).to_vec()).collect();
    assert_eq!(states, [vec![1, 0, 0, 0], vec![1, 1, 0, 0], vec![1, 1, 0, 0], vec![1, 1, 0, 0]]);
    assert_eq!(variables[3].labels(), ["0", "1"]);
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let said = |source: Result<Csv, Fault>| match source.and_then(|source| load(&source)) {
        Ok(_) => "nothing".to_owned(),
        Err(fault) => fault.to_string(),
    };
    let one = |text: &str| said(files(&[("t.csv", text)]));
    let cases = [
        one(""),
        one("a,b\n"),
        one("a,b\n1,2\n3\n"),
        one("a,a\n1,2\n"),
        one("a,b\n1,x\n,y\n"),
        one("a,b\n?,x\n,y\n"),
        one("a[0],a[2]\n1,2\n"),
        one(&std::iter::once("name".to_owned())
            .chain((0..300).map(|row| format!("trial{row}")))
            .collect::<Vec<_>>()
            .join("\n")),
        said(files(&[("1.csv", "a,b\n1,2\n"), ("2.csv", "a\n1\n")])),
    ];
    assert_eq!(
        cases,
        [
            "t.csv: the file is empty; its first line should name the columns",
            "the trials: there is no trial",
            "t.csv, line 3: 1 cell, and the first line names 2 columns",
            "t.csv, line 1: two columns are called `a`",
            "t.csv, line 3: `a` is missing",
            "the variables: `a` has no value in any trial",
            "the trials: there is no column `a[1]`",
            "the variables: `name` has more than 256 different words (`trial0`, `trial1`, `trial10` …); \
             leave it out, or declare what its states are",
            "2.csv: there is no column `b`, which the first file has",
        ]
    );
}

#[test]
fn a_value_that_is_no_state_is_refused_or_left_out_and_counted() {
    let variables = [
        Variable::of_intervals("xOff", vec![0.0, 1.0, 2.0]),
        Variable::of_words("colour", ["red", "blue"]),
    ];
    let source = csv("xOff,colour\n0.5,red\n1.5,bleu\n2.5,red\n,blue\n2,blue\n");
    let with = |missing, outside| stream::table(&source, &variables, Policy { missing, outside });
    let mut said = vec![with(Unfit::Refuse, Unfit::Refuse).unwrap_err().to_string()];
    said.push(with(Unfit::Refuse, Unfit::Drop).unwrap_err().to_string());
    let source = csv("xOff,colour\n2.5,red\n");
    said.push(stream::table(&source, &variables, Policy::default()).unwrap_err().to_string());
    let source = csv("xoff,colour\n2.5,red\n");
    said.push(stream::table(&source, &variables, Policy::default()).unwrap_err().to_string());
    assert_eq!(
        said,
        [
            "trials.csv, line 3: `colour` is `bleu`, which is no state of it; did you mean `blue`?",
            "trials.csv, line 5: `xOff` is missing",
            "trials.csv, line 2: `xOff` is 2.5, outside every interval of the model; they reach from 0 to 2",
            "the trials: there is no column `xOff`; did you mean `xoff`?",
        ]
    );
    let (table, dropped) = with(Unfit::Drop, Unfit::Drop).unwrap();
    assert_eq!(
        (table.column(VariableId(0)), table.column(VariableId(1)), dropped),
        (&[0, 1][..], &[0, 1][..], 3)
    );
}

#[test]
fn the_number_of_intervals_is_searched_by_what_it_predicts() {
    // The outcome is 1 where x lies in the middle third; z has no part in it.
    let mut random = fastrand::Rng::with_seed(3);
    let mut lines = vec!["x,z,ok".to_owned()];
    for _ in 0..3000 {
        let (x, z) = (random.f64() * 3.0, random.f64());
        let sure = random.f64() < 0.95;
        lines.push(format!("{x:.4},{z:.4},{}", u8::from((1.0..2.0).contains(&x) == sure)));
    }
    let source = csv(&lines.join("\n"));
    let mut declared = declare(&source);
    declared[0].cuts = Some(Cuts::Search);
    declared[1].cuts = Some(Cuts::Search);
    let survey = survey(&source, &declared).unwrap();
    let found = discretize(&source, &declared, &survey, Some("ok")).unwrap();
    let searched = found.searched.unwrap();
    assert_eq!(searched.predictors, ["x"]);
    assert!(
        [3, 6, 9].contains(&found.variables[0].arity()),
        "thirds can be told apart: {:?}",
        found.variables[0]
    );
    let best = searched.trials.iter().map(|trial| trial.skill.accuracy).fold(0.0, f64::max);
    assert!(best > 0.93, "{best}");
}

#[test]
fn parquet_says_what_csv_says() {
    let text = some_trials(3000);
    let from_csv = load(&csv(&text)).unwrap();
    let bytes = written(&text);
    let of = |bytes: &bytes::Bytes| -> Open<bytes::Bytes> {
        let bytes = bytes.clone();
        Box::new(move || Ok(bytes.clone()))
    };
    let source = Parquet::new(vec![("t.parquet".to_owned(), of(&bytes))]).unwrap();
    assert_eq!(source.shards(), 3, "each row group is a shard");
    assert_eq!(load(&source).unwrap(), from_csv);
    let cut = bytes.slice(..bytes.len() / 2);
    let fault = Parquet::new(vec![("cut.parquet".to_owned(), of(&cut))]).err().unwrap();
    assert!(fault.to_string().starts_with("cut.parquet: "), "{fault}");
}

#[test]
fn threads_that_read_one_file_do_not_disturb_each_other() {
    let text = some_trials(40_000);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.parquet");
    std::fs::write(&path, written(&text)).unwrap();
    let open: Open<std::fs::File> = Box::new(move || std::fs::File::open(&path));
    let source = Parquet::new(vec![("t.parquet".to_owned(), open)]).unwrap();
    let threads = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap();
    threads.install(|| {
        let table = load(&source).unwrap();
        assert_eq!(table, load(&csv(&text)).unwrap());
        let stream = Stream::new(&source, table.variables(), Policy::default()).unwrap();
        let sets = [vec![VariableId(0), VariableId(2)]];
        assert_eq!(stream.count(&sets).unwrap(), table.count(&sets).unwrap());
    });
}

/// The trials of [`some_trials`] as Parquet, a thousand in each row group.
fn written(text: &str) -> bytes::Bytes {
    use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
    let schema = "message trials { REQUIRED DOUBLE xOff; OPTIONAL BYTE_ARRAY colour (UTF8); REQUIRED INT64 onTop; }";
    let schema = Arc::new(parquet::schema::parser::parse_message_type(schema).unwrap());
    let mut writer =
        parquet::file::writer::SerializedFileWriter::new(Vec::new(), schema, Arc::default())
            .unwrap();
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    for rows in rows.chunks(1000) {
        let mut group = writer.next_row_group().unwrap();
        let numbers: Vec<f64> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&numbers, None, None).unwrap();
        column.close().unwrap();
        let words: Vec<ByteArray> = rows.iter().map(|row| row[1].into()).collect();
        let mut column = group.next_column().unwrap().unwrap();
        column
            .typed::<ByteArrayType>()
            .write_batch(&words, Some(&vec![1; words.len()]), None)
            .unwrap();
        column.close().unwrap();
        let whole: Vec<i64> = rows.iter().map(|row| row[2].parse().unwrap()).collect();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int64Type>().write_batch(&whole, None, None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
    }
    writer.into_inner().unwrap().into()
}
