//! A network and a number go in; so many trials of its first twenty variables come out, as Parquet in shards, and the graph among them.
//!
//! `cargo run --release -p caveat-causal --example rows -- ../shared/corpus/bif/alarm.bif 100000000 FOLDER`

use std::fs::{self, File};
use std::path::PathBuf;
use std::sync::Arc;

use causal::estimate::{Estimator, estimate};
use causal::file::{bif, json};
use causal::graph::Dag;
use causal::infer::sample::Sampler;
use causal::table::Table;
use causal::variable::VariableId;
use parquet::basic::Compression;
use parquet::data_type::{ByteArray, ByteArrayType};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use rayon::prelude::*;

/// As many variables as are written, and rows in a group and in a shard.
const VARIABLES: usize = 20;
const GROUP: usize = 1_000_000;
const SHARD: usize = 10_000_000;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let text = fs::read_to_string(&arguments[0]).expect("a network in BIF");
    let rows: usize = arguments[1].parse().expect("the number of rows");
    let folder = PathBuf::from(&arguments[2]);
    fs::create_dir_all(&folder).expect("the folder can be made");
    let network = bif::read(&text).expect("a network in BIF");
    let sampler = Sampler::new(&network);
    let names: Vec<String> =
        network.variables()[..VARIABLES].iter().map(|one| one.name.clone()).collect();
    let fields: Vec<String> =
        names.iter().map(|name| format!("REQUIRED BYTE_ARRAY {name} (UTF8);")).collect();
    let schema = Arc::new(
        parse_message_type(&format!("message trials {{ {} }}", fields.join(" ")))
            .expect("a schema"),
    );
    let words: Vec<Vec<ByteArray>> = network.variables()[..VARIABLES]
        .iter()
        .map(|variable| variable.labels().iter().map(|label| label.as_str().into()).collect())
        .collect();
    (0..rows.div_ceil(SHARD)).into_par_iter().for_each(|shard| {
        let file = File::create(folder.join(format!("{shard:03}.parquet"))).expect("a file");
        let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
        let mut writer = SerializedFileWriter::new(file, schema.clone(), Arc::new(properties))
            .expect("a writer");
        let end = rows.min((shard + 1) * SHARD);
        for start in (shard * SHARD..end).step_by(GROUP) {
            let mut columns = vec![vec![0; GROUP.min(end - start)]; network.variables().len()];
            sampler.fill(1, (start / GROUP) as u64, &mut columns);
            let mut group = writer.next_row_group().expect("a group");
            for (column, words) in columns.iter().zip(&words) {
                let values: Vec<ByteArray> =
                    column.iter().map(|&state| words[usize::from(state)].clone()).collect();
                let mut column = group.next_column().expect("a column").expect("one more");
                column
                    .typed::<ByteArrayType>()
                    .write_batch(&values, None, None)
                    .expect("it is written");
                column.close().expect("it is closed");
            }
            group.close().expect("it is closed");
        }
        writer.close().expect("it is closed");
    });
    let arcs = network.graph().arcs().filter(|(from, to)| from.index().max(to.index()) < VARIABLES);
    let graph = Dag::of_arcs(VARIABLES, arcs).expect("part of a graph has no cycle");
    let first: Vec<VariableId> = (0..VARIABLES as u16).map(VariableId).collect();
    let none =
        Table::new(network.variables().to_vec(), vec![Vec::new(); network.variables().len()])
            .expect("no rows");
    let model =
        estimate(&none.project(&first), &graph, Estimator::Bdeu(1.0)).expect("a prior alone");
    fs::write(folder.join("model.cbn.json"), json::write(&model)).expect("the model is written");
}
