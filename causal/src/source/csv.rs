//! CSV goes in; blocks of its cells come out. Each file is a shard, and all have the columns of the first, in any order.

use std::io::{self, Read};

use csv::{ByteRecord, ReaderBuilder};

use super::{BLOCK, Block, Cells, Fault, Source, Texts};

/// Opens a file of trials again, whenever it is to be read.
pub type Open = Box<dyn Fn() -> io::Result<Box<dyn Read + Send>> + Sync + Send>;

/// Trials in CSV files.
pub struct Csv {
    columns: Vec<String>,
    shards: Vec<Shard>,
}

struct Shard {
    name: String,
    open: Open,
    /// Where each column of the first file is in this one.
    order: Vec<usize>,
}

impl Csv {
    /// Reads the first line of each file. Each comes with its name, for messages.
    pub fn new(files: Vec<(String, Open)>) -> Result<Self, Fault> {
        let mut columns: Vec<String> = Vec::new();
        let mut shards = Vec::with_capacity(files.len());
        for (at, (name, open)) in files.into_iter().enumerate() {
            let header = header(&name, &open)?;
            if at == 0 {
                columns.clone_from(&header);
            }
            let order: Vec<usize> = columns
                .iter()
                .map(|column| {
                    header.iter().position(|one| one == column).ok_or_else(|| {
                        Fault::new(
                            &name,
                            format!("there is no column `{column}`, which the first file has"),
                        )
                    })
                })
                .collect::<Result<_, _>>()?;
            if let Some(more) = header.iter().find(|one| !columns.contains(one)) {
                return Err(Fault::new(&name, format!("the first file has no column `{more}`")));
            }
            shards.push(Shard { name, open, order });
        }
        Ok(Self { columns, shards })
    }
}

/// The names of the columns of a file.
fn header(name: &str, open: &Open) -> Result<Vec<String>, Fault> {
    let mut reader = reader(name, open)?;
    let mut record = ByteRecord::new();
    let any = reader.read_byte_record(&mut record).map_err(|error| fault(name, &error))?;
    let header: Vec<String> = record
        .iter()
        .map(|cell| match std::str::from_utf8(cell.trim_ascii()) {
            Ok(text) => Ok(text.trim_start_matches('\u{feff}').to_owned()),
            Err(_) => {
                Err(Fault::new(format!("{name}, line 1"), "the names of the columns are not UTF-8"))
            }
        })
        .collect::<Result<_, _>>()?;
    if !any || header.iter().all(String::is_empty) {
        return Err(Fault::new(name, "the file is empty; its first line should name the columns"));
    }
    for (at, column) in header.iter().enumerate() {
        if column.is_empty() {
            return Err(Fault::new(
                format!("{name}, line 1"),
                format!("column {} has no name", at + 1),
            ));
        }
        if header[..at].contains(column) {
            return Err(Fault::new(
                format!("{name}, line 1"),
                format!("two columns are called `{column}`"),
            ));
        }
    }
    Ok(header)
}

fn reader(name: &str, open: &Open) -> Result<csv::Reader<Box<dyn Read + Send>>, Fault> {
    let file = open().map_err(|error| Fault::new(name, error.to_string()))?;
    Ok(ReaderBuilder::new().has_headers(false).flexible(true).comment(Some(b'#')).from_reader(file))
}

fn fault(name: &str, error: &csv::Error) -> Fault {
    match error.kind() {
        csv::ErrorKind::Io(error) => Fault::new(name, error.to_string()),
        _ => Fault::new(name, error.to_string()),
    }
}

impl Source for Csv {
    fn columns(&self) -> &[String] {
        &self.columns
    }

    fn shards(&self) -> usize {
        self.shards.len()
    }

    fn place(&self, shard: usize, row: u64) -> String {
        format!("{}, line {row}", self.shards[shard].name)
    }

    fn read(
        &self,
        shard: usize,
        columns: &[usize],
        each: &mut dyn FnMut(&Block) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let Shard { name, open, order } = &self.shards[shard];
        let mut reader = reader(name, open)?;
        let mut record = ByteRecord::new();
        reader.read_byte_record(&mut record).map_err(|error| fault(name, &error))?;
        let empty = || Block {
            rows: Vec::with_capacity(BLOCK),
            columns: columns.iter().map(|_| Cells::Text(Texts::default())).collect(),
        };
        let mut block = empty();
        loop {
            let more = reader.read_byte_record(&mut record).map_err(|error| fault(name, &error))?;
            if !more || block.rows.len() == BLOCK {
                if !block.rows.is_empty() {
                    each(&block)?;
                }
                if !more {
                    return Ok(());
                }
                block = empty();
            }
            let line = record.position().map_or(0, csv::Position::line);
            if record.len() != order.len() {
                let cells = match record.len() {
                    1 => "1 cell".to_owned(),
                    several => format!("{several} cells"),
                };
                let what = format!("{cells}, and the first line names {} columns", order.len());
                return Err(Fault::new(self.place(shard, line), what));
            }
            block.rows.push(line);
            for (cells, &column) in block.columns.iter_mut().zip(columns) {
                if let Cells::Text(texts) = cells {
                    texts.push(&record[order[column]]);
                }
            }
        }
    }
}
