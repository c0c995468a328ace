//! Parquet goes in; blocks of its cells come out. Each row group is a shard.

use std::io;

use parquet::basic::Type;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use rustc_hash::FxHashMap;

use super::{BLOCK, Block, Cells, Fault, MISSING, Source};

/// Opens a file again. What is opened must have a place of its own to read from: clones of one file share theirs, and threads would
/// read from each other's.
pub type Open<R> = Box<dyn Fn() -> io::Result<R> + Sync + Send>;

/// Trials in Parquet files.
pub struct Parquet<R: ChunkReader + 'static> {
    columns: Vec<String>,
    files: Vec<File<R>>,
    /// The file and the row group of each shard, and the number of its first row.
    shards: Vec<(usize, usize, u64)>,
}

struct File<R: ChunkReader + 'static> {
    name: String,
    open: Open<R>,
    /// Where each column of the first file is in this one.
    order: Vec<usize>,
}

impl<R: ChunkReader + 'static> Parquet<R> {
    /// Reads what each file says of itself at its end. Each comes with its name, for messages.
    pub fn new(files: Vec<(String, Open<R>)>) -> Result<Self, Fault> {
        let mut this = Self { columns: Vec::new(), files: Vec::new(), shards: Vec::new() };
        for (name, open) in files {
            let reader = reader(&name, &open)?;
            let header: Vec<String> = names(&name, &reader)?;
            if this.files.is_empty() {
                this.columns.clone_from(&header);
            }
            let place = |column: &String| {
                header.iter().position(|one| one == column).ok_or_else(|| {
                    Fault::new(
                        &name,
                        format!("there is no column `{column}`, which the first file has"),
                    )
                })
            };
            let order: Vec<usize> = this.columns.iter().map(place).collect::<Result<_, _>>()?;
            let mut first = 1;
            for group in 0..reader.num_row_groups() {
                this.shards.push((this.files.len(), group, first));
                first += reader.metadata().row_group(group).num_rows() as u64;
            }
            this.files.push(File { name, open, order });
        }
        Ok(this)
    }
}

/// Opens a file, and reads what it says of itself.
fn reader<R: ChunkReader + 'static>(
    name: &str,
    open: &Open<R>,
) -> Result<SerializedFileReader<R>, Fault> {
    let file = open().map_err(|error| Fault::new(name, error.to_string()))?;
    SerializedFileReader::new(file).map_err(|error| fault(name, &error))
}

/// The columns of a file: each plain, since a trial is a row of plain values.
fn names<R: ChunkReader + 'static>(
    name: &str,
    reader: &SerializedFileReader<R>,
) -> Result<Vec<String>, Fault> {
    let schema = reader.metadata().file_metadata().schema_descr();
    schema
        .columns()
        .iter()
        .map(|column| {
            if column.max_rep_level() > 0 || column.path().parts().len() > 1 {
                let what =
                    format!("column `{}` is nested; trials have plain columns", column.path());
                return Err(Fault::new(name, what));
            }
            match column.physical_type() {
                Type::INT96 | Type::FIXED_LEN_BYTE_ARRAY => {
                    let what =
                        format!("column `{}` holds {}", column.name(), column.physical_type());
                    Err(Fault::new(name, format!("{what}; numbers and words can be read")))
                }
                _ => Ok(column.name().to_owned()),
            }
        })
        .collect()
}

fn fault(name: &str, error: &ParquetError) -> Fault {
    Fault::new(name, error.to_string())
}

impl<R: ChunkReader + 'static> Source for Parquet<R> {
    fn columns(&self) -> &[String] {
        &self.columns
    }

    fn shards(&self) -> usize {
        self.shards.len()
    }

    fn place(&self, shard: usize, row: u64) -> String {
        format!("{}, row {row}", self.files[self.shards[shard].0].name)
    }

    fn read(
        &self,
        shard: usize,
        columns: &[usize],
        each: &mut dyn FnMut(&Block) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let (file, group, first) = self.shards[shard];
        let File { name, open, order } = &self.files[file];
        let reader = reader(name, open)?;
        let complain = |error: ParquetError| fault(name, &error);
        let group = reader.get_row_group(group).map_err(complain)?;
        let mut readers: Vec<Column> = columns
            .iter()
            .map(|&column| {
                let optional = reader
                    .metadata()
                    .file_metadata()
                    .schema_descr()
                    .column(order[column])
                    .max_def_level()
                    > 0;
                let reader = group.get_column_reader(order[column])?;
                Ok(Column { reader, optional, levels: Vec::new(), words: Words::default() })
            })
            .collect::<Result<_, ParquetError>>()
            .map_err(complain)?;
        let rows = group.metadata().num_rows() as u64;
        let mut done = 0;
        while done < rows {
            let length = (rows - done).min(BLOCK as u64) as usize;
            let numbers = first + done..first + done + length as u64;
            let cells: Vec<Cells> = readers
                .iter_mut()
                .map(|column| column.read(length))
                .collect::<Result<_, _>>()
                .map_err(complain)?;
            each(&Block { rows: numbers.collect(), columns: cells })?;
            done += length as u64;
        }
        Ok(())
    }
}

/// A column that is being read.
struct Column {
    reader: ColumnReader,
    optional: bool,
    levels: Vec<i16>,
    words: Words,
}

/// The words of a column so far.
#[derive(Default)]
struct Words {
    all: Vec<String>,
    numbers: FxHashMap<String, u32>,
}

impl Column {
    /// The next cells.
    fn read(&mut self, rows: usize) -> Result<Cells, ParquetError> {
        let Self { reader, optional, levels, words } = self;
        let number = match reader {
            ColumnReader::BoolColumnReader(reader) => {
                plain(reader, rows, *optional, levels, |&value| f64::from(u8::from(value)))
            }
            ColumnReader::Int32ColumnReader(reader) => {
                plain(reader, rows, *optional, levels, |&value| f64::from(value))
            }
            ColumnReader::Int64ColumnReader(reader) => {
                plain(reader, rows, *optional, levels, |&value| value as f64)
            }
            ColumnReader::FloatColumnReader(reader) => {
                plain(reader, rows, *optional, levels, |&value| f64::from(value))
            }
            ColumnReader::DoubleColumnReader(reader) => {
                plain(reader, rows, *optional, levels, |&value| value)
            }
            ColumnReader::ByteArrayColumnReader(reader) => {
                let values = records(reader, rows, *optional, levels)?;
                let codes = words.codes(&values)?;
                let codes = spread(codes, rows, *optional, levels, MISSING);
                return Ok(Cells::Words(words.all.clone(), codes));
            }
            ColumnReader::Int96ColumnReader(_) | ColumnReader::FixedLenByteArrayColumnReader(_) => {
                unreachable!("such columns were refused when the file was opened")
            }
        };
        number.map(Cells::Numbers)
    }
}

/// Reads as many records as there are rows; `levels` says which of them have a value.
fn records<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    rows: usize,
    optional: bool,
    levels: &mut Vec<i16>,
) -> Result<Vec<T::T>, ParquetError> {
    levels.clear();
    let mut values = Vec::with_capacity(rows);
    let mut read = 0;
    while read < rows {
        let levels = optional.then_some(&mut *levels);
        let (records, _, _) = reader.read_records(rows - read, levels, None, &mut values)?;
        if records == 0 {
            return Err(ParquetError::EOF(format!("a column ends after {read} of {rows} rows")));
        }
        read += records;
    }
    Ok(values)
}

fn plain<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    rows: usize,
    optional: bool,
    levels: &mut Vec<i16>,
    number: impl Fn(&T::T) -> f64,
) -> Result<Vec<f64>, ParquetError> {
    let values = records(reader, rows, optional, levels)?;
    Ok(spread(values.iter().map(number).collect(), rows, optional, levels, f64::NAN))
}

/// Puts values into the rows that have one.
fn spread<V: Copy>(
    values: Vec<V>,
    rows: usize,
    optional: bool,
    levels: &[i16],
    missing: V,
) -> Vec<V> {
    if !optional || values.len() == rows {
        return values;
    }
    let mut values = values.into_iter();
    levels
        .iter()
        .map(|&level| if level > 0 { values.next().unwrap_or(missing) } else { missing })
        .collect()
}

impl Words {
    /// The number of each word.
    ///
    /// The values of a page share the bytes of its dictionary, so that where bytes lie tells the word, as long as the page lives: for
    /// these values.
    fn codes(&mut self, values: &[ByteArray]) -> Result<Vec<u32>, ParquetError> {
        let mut known: FxHashMap<(usize, usize), u32> = FxHashMap::default();
        let mut before = ((0, 0), MISSING);
        let mut codes = Vec::with_capacity(values.len());
        for value in values {
            let data = value.data();
            let key = (data.as_ptr() as usize, data.len());
            if key == before.0 {
                codes.push(before.1);
                continue;
            }
            let code = if let Some(&code) = known.get(&key) {
                code
            } else {
                let code = self.number(data)?;
                known.insert(key, code);
                code
            };
            before = (key, code);
            codes.push(code);
        }
        Ok(codes)
    }

    fn number(&mut self, word: &[u8]) -> Result<u32, ParquetError> {
        let word = std::str::from_utf8(word.trim_ascii())
            .map_err(|error| ParquetError::General(format!("a word is not UTF-8: {error}")))?;
        if super::is_missing(word.as_bytes()) {
            return Ok(MISSING);
        }
        if let Some(&number) = self.numbers.get(word) {
            return Ok(number);
        }
        let number = self.all.len() as u32;
        self.all.push(word.to_owned());
        self.numbers.insert(word.to_owned(), number);
        Ok(number)
    }
}
