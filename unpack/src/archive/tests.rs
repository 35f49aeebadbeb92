//! Archives are made here by the same crate that reads them, but for the encrypted ones.

use std::io::Write;

use zip::write::SimpleFileOptions;
use zip::{AesMode, CompressionMethod, ZipWriter};

use super::*;

fn archive(files: &[(&str, &[u8], SimpleFileOptions)]) -> Vec<u8> {
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes, options) in files {
        out.start_file(*name, *options).unwrap();
        out.write_all(bytes).unwrap();
    }
    out.finish().unwrap().into_inner()
}

fn stored(method: CompressionMethod) -> SimpleFileOptions {
    SimpleFileOptions::default().compression_method(method)
}

fn open(bytes: Vec<u8>, password: Option<&str>) -> Archive {
    let password = password.map(str::as_bytes);
    Archive::open(bytes, password, Limits::default()).unwrap()
}

#[test]
fn entries_come_out_however_they_are_packed() {
    let methods = [
        CompressionMethod::Stored,
        CompressionMethod::Deflated,
        CompressionMethod::Bzip2,
    ];
    let text = b"Cube { } ".repeat(1000);
    for method in methods {
        let options = stored(method);
        let bytes = archive(&[("a.iv", &text, options), ("dir/b.iv", b"B", options)]);
        let archive = open(bytes, None);
        let names: Vec<&str> = archive.entries.iter().map(|e| &*e.name).collect();
        assert_eq!(names, ["a.iv", "dir/b.iv"]);
        assert!(archive.read(&archive.entries[0]).unwrap() == text);
        assert_eq!(archive.read(&archive.entries[1]).unwrap(), b"B");
        assert_eq!(
            archive.beginning(&archive.entries[0], 6).unwrap(),
            b"Cube {"
        );
    }
}

#[test]
fn passwords_open_what_takes_one() {
    let aes = [AesMode::Aes128, AesMode::Aes192, AesMode::Aes256].map(|mode| {
        let options = stored(CompressionMethod::Deflated).with_aes_encryption(mode, "secret");
        let mut out = ZipWriter::new(Cursor::new(Vec::new()));
        out.start_file("a.iv", options).unwrap();
        out.write_all(b"Cube { }").unwrap();
        out.finish().unwrap().into_inner()
    });
    for bytes in aes.into_iter().chain([ZIP_CRYPTO.to_vec()]) {
        let read = |password| {
            let archive = open(bytes.clone(), password);
            archive.read(&archive.entries[0])
        };
        assert_eq!(read(None), Err(Error::PasswordNeeded));
        assert_eq!(read(Some("guess")), Err(Error::PasswordWrong));
        assert_eq!(read(Some("secret")).unwrap(), b"Cube { }");
    }
}

/// Made by Info-ZIP's `zip -0 -P secret`.
const ZIP_CRYPTO: &[u8] = include_bytes!("zipcrypto.zip");

#[test]
fn entries_that_lead_out_are_refused() {
    let options = stored(CompressionMethod::Stored);
    // The writer would not take such names: they are put in place of others as long.
    let mut bytes = archive(&[("aaaa.iv", b"A", options), ("good.iv", b"B", options)]);
    for at in 0..bytes.len() - 7 {
        if &bytes[at..at + 7] == b"aaaa.iv" {
            bytes[at..at + 7].copy_from_slice(b"../a.iv");
        }
    }
    let archive = open(bytes, None);
    assert_eq!(archive.entries.len(), 1);
    assert_eq!(archive.refused.len(), 1);
    assert_eq!(archive.refused[0].why, NameFault::LeadsOut);

    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    out.add_symlink("link.iv", "/etc/passwd", options).unwrap();
    let archive = open(out.finish().unwrap().into_inner(), None);
    assert_eq!(archive.entries, []);
    assert_eq!(archive.refused[0].why, NameFault::Link);
}

#[test]
fn of_entries_of_one_name_the_last_is_taken() {
    let options = stored(CompressionMethod::Stored);
    // The writer would not take a name twice: they are put in place of others as long.
    for (name, is_repeated) in [(b"ab.iv", true), (b"a\\b.i", false), (b"x/b.i", false)] {
        let mut bytes = archive(&[("11.iv", b"A", options), ("22.iv", b"B", options)]);
        for at in 0..bytes.len() - 5 {
            if matches!(&bytes[at..at + 5], b"11.iv" | b"22.iv")
                && (is_repeated || bytes[at] == b'1')
            {
                bytes[at..at + 5].copy_from_slice(name);
            }
        }
        let archive = open(bytes, None);
        assert_eq!(archive.has_repeated_names, is_repeated);
        assert_eq!(archive.entries.len(), if is_repeated { 1 } else { 2 });
        let last = archive.entries.last().unwrap();
        assert_eq!(archive.read(last).unwrap(), b"B");
    }
    // The same name in two ways of writing it.
    let bytes = archive(&[("./a.iv", b"A", options), ("a.iv", b"B", options)]);
    let archive = open(bytes, None);
    assert!(archive.has_repeated_names);
    let read: Vec<_> = archive.entries.iter().map(|e| archive.read(e)).collect();
    assert_eq!(read, [Ok(b"B".to_vec())]);
}

#[test]
fn too_much_is_refused() {
    let options = stored(CompressionMethod::Deflated);
    let zeros = vec![0; 80 << 20];
    let bytes = archive(&[("a", &zeros, options)]);
    let bomb = open(bytes, None);
    let refused = bomb.read(&bomb.entries[0]);
    assert_eq!(refused, Err(Error::Bomb { ratio: 200 }));

    // All entries together count.
    let files: Vec<(String, Vec<u8>)> = (0..5).map(|i| (i.to_string(), vec![0; 1000])).collect();
    let files: Vec<_> = files.iter().map(|(n, b)| (&**n, &b[..], options)).collect();
    let limits = Limits::of_bytes(3500);
    let many = Archive::open(archive(&files), None, limits).unwrap();
    let read: Vec<bool> = many.entries.iter().map(|e| many.read(e).is_ok()).collect();
    assert_eq!(read, [true, true, true, false, false]);
}

#[test]
fn any_bytes_end() {
    let options = stored(CompressionMethod::Deflated);
    let whole = archive(&[
        ("a.iv", b"Cube { } Cube { }", options),
        ("b", b"B", options),
    ]);
    let try_all = |bytes: Vec<u8>| {
        if let Ok(archive) = Archive::open(bytes, Some(b"x"), Limits::default()) {
            for entry in &archive.entries {
                let _ = archive.read(entry);
            }
        }
    };
    for at in 0..whole.len() {
        try_all(whole[..at].to_vec());
        for bit in [1, 0x80] {
            let mut bytes = whole.clone();
            bytes[at] ^= bit;
            try_all(bytes);
        }
    }
}

#[test]
fn claims_of_many_entries_are_not_believed() {
    let mut bytes = archive(&[("a", b"A", stored(CompressionMethod::Stored))]);
    let mut record = b"PK\x06\x06".to_vec();
    record.extend(44_u64.to_le_bytes());
    record.extend([0; 12]);
    record.extend(100_000_000_u64.to_le_bytes());
    record.extend([0; 24]);
    bytes.splice(0..0, record);
    let refused = Archive::open(bytes, None, Limits::default());
    assert_eq!(refused.err(), Some(Error::TooManyEntries));
}
