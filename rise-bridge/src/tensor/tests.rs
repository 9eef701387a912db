//! Round trips, truncated files and invalid headers.

use std::io::Cursor;

use super::{NumberType, TensorError, TensorField, TensorReader, TensorWriter};

fn example() -> Vec<u8> {
    let fields = vec![
        TensorField::new("note", NumberType::U8, &[5]),
        TensorField::new("wvls", NumberType::U16, &[2]),
        TensorField::new("M", NumberType::F32, &[2, 3]),
    ];
    let mut writer = TensorWriter::begin(Vec::new(), fields).unwrap();
    writer.bytes(b"hello").unwrap();
    writer.bytes(&[194, 1, 38, 2]).unwrap();
    writer.f32s([1.0, 2.0, 3.0]).unwrap();
    writer.f32s([4.0, 5.0, 6.5]).unwrap();
    writer.finish().unwrap()
}

#[test]
fn what_was_written_is_read_whole_and_in_pieces() {
    let mut file = TensorReader::open(Cursor::new(example())).unwrap();
    assert_eq!(file.numbers("wvls").unwrap(), [450.0, 550.0]);
    assert_eq!(file.numbers("M").unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.5]);
    assert_eq!(file.f32s("M", 2, 2).unwrap(), [3.0, 4.0]);
    assert_eq!(file.field("M").unwrap().shape, [2, 3]);
    assert!(file.fields().iter().all(|field| field.offset % 8 == 0));
    assert!(file.f32s("M", 5, 2).is_err());
    assert!(file.numbers("N").is_err());
}

#[test]
fn every_cut_is_found() {
    let whole = example();
    for len in 0..whole.len() {
        assert!(TensorReader::open(Cursor::new(&whole[..len])).is_err(), "{len} bytes");
    }
}

#[test]
fn absurd_headers_are_refused_without_taking_memory() {
    let mut many = example();
    many[14..18].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(TensorReader::open(Cursor::new(many)), Err(TensorError::Damaged(_))));
    let mut wide = example();
    // The shape of the first field.
    let at = 18 + 2 + 4 + 2 + 1 + 8;
    wide[at..at + 8].copy_from_slice(&u64::MAX.to_le_bytes());
    assert!(matches!(TensorReader::open(Cursor::new(wide)), Err(TensorError::Damaged(_))));
    assert!(matches!(TensorReader::open(Cursor::new(b"RIFF")), Err(TensorError::NotATensor)));
}

#[test]
fn a_file_without_all_its_data_is_not_finished() {
    let fields = vec![TensorField::new("M", NumberType::F32, &[2])];
    let mut writer = TensorWriter::begin(Vec::new(), fields).unwrap();
    writer.f32s([1.0]).unwrap();
    assert!(writer.finish().is_err());
}
