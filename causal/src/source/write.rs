//! Trials go in, block after block; a file of CSV or Parquet comes out, which can be read again.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

/// What a column of a file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Head {
    /// What it is called.
    pub name: String,
    /// The words that its numbers stand for; none where it holds the numbers themselves.
    pub words: Option<Vec<String>>,
}

/// A file that is being written.
pub enum Writer<W: Write + Send> {
    /// Lines of text, the names first.
    Csv(Vec<Head>, W),
    /// Groups of rows.
    Parquet(Vec<Head>, Box<SerializedFileWriter<W>>),
}

impl<W: Write + Send> Writer<W> {
    /// Begins a file of CSV.
    pub fn csv(heads: Vec<Head>, mut out: W) -> io::Result<Self> {
        let names: Vec<String> = heads.iter().map(|head| quoted(&head.name)).collect();
        writeln!(out, "{}", names.join(","))?;
        Ok(Self::Csv(heads, out))
    }

    /// Begins a file of Parquet.
    pub fn parquet(heads: Vec<Head>, out: W) -> io::Result<Self> {
        let field = |head: &Head| {
            let built = match head.words {
                None => Type::primitive_type_builder(&head.name, Physical::DOUBLE),
                Some(_) => Type::primitive_type_builder(&head.name, Physical::BYTE_ARRAY)
                    .with_logical_type(Some(LogicalType::String)),
            };
            built.with_repetition(Repetition::REQUIRED).build().map(Arc::new).map_err(broken)
        };
        let fields = heads.iter().map(field).collect::<io::Result<Vec<_>>>()?;
        let schema = Type::group_type_builder("trials").with_fields(fields).build();
        let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
        let writer =
            SerializedFileWriter::new(out, Arc::new(schema.map_err(broken)?), Arc::new(properties))
                .map_err(broken)?;
        Ok(Self::Parquet(heads, Box::new(writer)))
    }

    /// Writes rows, each with a number for each column.
    pub fn rows(&mut self, rows: &[Vec<f64>]) -> io::Result<()> {
        match self {
            Self::Csv(heads, out) => {
                for row in rows {
                    let cells: Vec<String> =
                        heads.iter().zip(row).map(|(head, &cell)| text(head, cell)).collect();
                    writeln!(out, "{}", cells.join(","))?;
                }
                Ok(())
            }
            Self::Parquet(heads, writer) => group(heads, writer, rows).map_err(broken),
        }
    }

    /// Ends the file.
    pub fn end(self) -> io::Result<()> {
        match self {
            Self::Csv(_, mut out) => out.flush(),
            Self::Parquet(_, writer) => writer.close().map(|_| ()).map_err(broken),
        }
    }
}

fn group<W: Write + Send>(
    heads: &[Head],
    writer: &mut SerializedFileWriter<W>,
    rows: &[Vec<f64>],
) -> parquet::errors::Result<()> {
    let mut group = writer.next_row_group()?;
    for (at, head) in heads.iter().enumerate() {
        let mut column = group.next_column()?.expect("there is a column for each head");
        let cells = rows.iter().map(|row| row[at]);
        match &head.words {
            None => {
                let values: Vec<f64> = cells.collect();
                column.typed::<DoubleType>().write_batch(&values, None, None)?;
            }
            Some(words) => {
                let words: Vec<ByteArray> = words.iter().map(|word| word.as_str().into()).collect();
                let values: Vec<ByteArray> =
                    cells.map(|cell| words[cell as usize].clone()).collect();
                column.typed::<ByteArrayType>().write_batch(&values, None, None)?;
            }
        }
        column.close()?;
    }
    group.close().map(|_| ())
}

fn text(head: &Head, cell: f64) -> String {
    match &head.words {
        None => cell.to_string(),
        Some(words) => quoted(&words[cell as usize]),
    }
}

/// A cell of CSV.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        return format!("\"{}\"", text.replace('"', "\"\""));
    }
    text.to_owned()
}

fn broken(error: parquet::errors::ParquetError) -> io::Error {
    io::Error::other(error)
}
