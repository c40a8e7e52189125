//! Outcomes as Parquet, for programs.

use std::io;
use std::sync::Arc;

use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::columns::{Cells, Column, columns};
use crate::grid::Sweep;
use crate::header::Header;
use crate::outcome::Outcome;

/// Writes the outcomes as Parquet, compressed with Snappy: counts as unsigned 64-bit integers,
/// numbers as doubles, strings as UTF-8.
///
/// The file's metadata has the identity of the sweep: `afp.program`, `afp.plan_hash`,
/// `afp.world_hash`, `afp.seeds`, `afp.grid`, and `afp.plan`, the plan's path.
///
/// # Errors
/// Two columns have the same name.
pub fn to_parquet(sweep: &Sweep, outcomes: &[Outcome], header: &Header) -> io::Result<Vec<u8>> {
    let facts = [
        ("afp.program", header.program.clone()),
        ("afp.plan", sweep.plan.clone()),
        ("afp.plan_hash", header.plan.clone()),
        ("afp.world_hash", header.worlds.clone()),
        ("afp.seeds", sweep.seeds.to_string()),
        ("afp.grid", header.grid.clone()),
    ];
    let facts = facts.map(|(key, value)| KeyValue::new(key.to_owned(), value));
    write(&columns(sweep, outcomes), facts.into()).map_err(io::Error::other)
}

fn write(columns: &[Column], facts: Vec<KeyValue>) -> Result<Vec<u8>> {
    let fields = columns.iter().map(|column| Ok(Arc::new(field(column)?)));
    let fields = fields.collect::<Result<Vec<TypePtr>>>()?;
    let schema = Arc::new(Type::group_type_builder("outcomes").with_fields(fields).build()?);
    let mut bytes = Vec::new();
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(facts))
        .build();
    let mut file = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    let mut columns = columns.iter();
    while let Some(mut writer) = group.next_column()? {
        if let Some(column) = columns.next() {
            fill(&mut writer, &column.cells)?;
        }
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}

fn field(column: &Column) -> Result<Type> {
    let (physical, repetition, converted, logical) = match column.cells {
        Cells::Counts(_) => {
            let logical = LogicalType::integer(64, false);
            (Physical::INT64, Repetition::OPTIONAL, ConvertedType::UINT_64, Some(logical))
        }
        Cells::Numbers(_) => (Physical::DOUBLE, Repetition::OPTIONAL, ConvertedType::NONE, None),
        Cells::Texts(_) => {
            let logical = Some(LogicalType::String);
            (Physical::BYTE_ARRAY, Repetition::REQUIRED, ConvertedType::UTF8, logical)
        }
    };
    Type::primitive_type_builder(&column.name, physical)
        .with_repetition(repetition)
        .with_converted_type(converted)
        .with_logical_type(logical)
        .build()
}

fn fill(writer: &mut SerializedColumnWriter<'_>, cells: &Cells) -> Result<()> {
    match cells {
        Cells::Counts(all) => {
            // The column type declares these bits as unsigned.
            let there: Vec<i64> = all.iter().flatten().map(|count| count.cast_signed()).collect();
            writer.typed::<Int64Type>().write_batch(&there, Some(&levels(all)), None)?;
        }
        Cells::Numbers(all) => {
            let there: Vec<f64> = all.iter().copied().flatten().collect();
            writer.typed::<DoubleType>().write_batch(&there, Some(&levels(all)), None)?;
        }
        Cells::Texts(all) => {
            let all: Vec<ByteArray> = all.iter().map(|text| text.as_str().into()).collect();
            writer.typed::<ByteArrayType>().write_batch(&all, None, None)?;
        }
    }
    Ok(())
}

/// Marks the cells with a value.
fn levels<T>(cells: &[Option<T>]) -> Vec<i16> {
    cells.iter().map(|cell| i16::from(cell.is_some())).collect()
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::*;
    use crate::table::tests::{header, outcomes, sweep};

    #[test]
    fn parquet_keeps_types_and_gaps() {
        let bytes = to_parquet(&sweep(), &outcomes(), &header()).unwrap();
        let reader = SerializedFileReader::new(parquet_bytes(bytes)).unwrap();
        let facts = reader.metadata().file_metadata().key_value_metadata().unwrap();
        let fact =
            |key: &str| facts.iter().find(|it| it.key == key).unwrap().value.clone().unwrap();
        assert_eq!((&*fact("afp.plan_hash"), &*fact("afp.seeds")), ("1234", "3..5"));
        let group = reader.metadata().row_group(0);
        assert!(matches!(group.column(0).compression(), Compression::SNAPPY));
        let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 2);
        let at = |name| rows[0].get_column_iter().position(|(column, _)| column == name).unwrap();
        assert_eq!(rows[1].get_ulong(at("run")).unwrap(), u64::MAX / 4 * 4);
        assert_eq!(rows[0].get_string(at("why")).unwrap(), "a, \"b\"");
        assert!(rows[0].get_double(at("wall_error_mean_m")).is_err());
        assert!(rows[0].get_double(at("time_s")).is_err(), "it never started");
        assert!(rows[0].get_ulong(at("collisions")).is_err(), "it never started");
        assert_eq!(rows[1].get_ulong(at("collisions")).unwrap(), 0);
        assert_eq!(rows[1].get_double(at("wall_error_mean_m")).unwrap(), 0.1);
    }

    fn parquet_bytes(bytes: Vec<u8>) -> std::fs::File {
        use std::io::{Seek, Write};
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        file.rewind().unwrap();
        file
    }
}
