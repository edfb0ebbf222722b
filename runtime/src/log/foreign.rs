//! Files that are no logs, told by their first bytes, and how a log is made of each.

use super::LogError;

/// As many bytes as tell all kinds.
pub(super) const BYTES: usize = 8;

/// First bytes, what begins with them, and what to do.
const KINDS: [(&[u8], &str, &str); 20] = [
    (
        b"#ROSBAG",
        "a bag of ROS 1",
        "`rosbags-convert --src run.bag --dst run` writes one of ROS 2, with `--dst-storage mcap` as MCAP, which is read",
    ),
    (
        b"SQLite f",
        "a database, as bags of ROS 2 with storage `sqlite3` are",
        "`ros2 bag convert` with `storage_id: mcap` writes it as MCAP, which is read",
    ),
    (b"MATLAB 5", "a file of MATLAB", IN_MATLAB),
    (b"MATLAB 7", "a file of MATLAB", IN_MATLAB),
    (
        b"\x89HDF\r\n\x1a\n",
        "an HDF5 file",
        "write its channels as CSV or Parquet, as `pandas.DataFrame.to_csv` does",
    ),
    (
        b"\x93NUMPY",
        "an array of NumPy",
        "`numpy.savetxt(\"log.csv\", a, delimiter=\",\", header=\"time,q1,..,tau1,..\")` writes it as CSV",
    ),
    (
        b"PK\x03\x04",
        "a ZIP archive or a workbook of a spreadsheet",
        "unpack it and name the log in it, or save the sheet as CSV",
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "a workbook of a spreadsheet",
        "save the sheet as CSV",
    ),
    (b"7z\xbc\xaf", "a 7-Zip archive", UNPACK),
    (
        b"\xfd7zXZ",
        "a file packed by xz",
        "`unxz` unpacks it; gzip is read as it is",
    ),
    (
        b"\x28\xb5\x2f\xfd",
        "a file packed by zstd",
        "`unzstd` unpacks it; gzip is read as it is",
    ),
    (
        b"BZh",
        "a file packed by bzip2",
        "`bunzip2` unpacks it; gzip is read as it is",
    ),
    (
        b"<?xml",
        "XML, as URDFs are",
        "name the log after the spec; `robot-model import` makes a spec of a URDF",
    ),
    (b"%PDF", "a PDF file", OF_NUMBERS),
    (
        b"\x80\x04",
        "a pickle of Python",
        "write it as CSV or Parquet, as `pandas.DataFrame.to_csv` does",
    ),
    (b"\x89PNG\r\n\x1a\n", "a picture (PNG)", OF_NUMBERS),
    (b"\xff\xd8\xff", "a picture (JPEG)", OF_NUMBERS),
    (b"GIF87a", "a picture (GIF)", OF_NUMBERS),
    (b"GIF89a", "a picture (GIF)", OF_NUMBERS),
    (b"\x7fELF", "a program or a library (ELF)", OF_NUMBERS),
];

const OF_NUMBERS: &str = "name the file that has the numbers";

const IN_MATLAB: &str =
    "`writetable(table(time, q1, .., tau1, ..), \"log.csv\")` writes its channels as CSV";
const UNPACK: &str = "unpack it, and name the log in it";

/// Refuses a file that is of a kind that is known and not read.
///
/// # Errors
/// [`LogError::Foreign`]
pub(super) fn check(source: &str, start: &[u8]) -> Result<(), LogError> {
    let mut kinds = KINDS.iter();
    let found = kinds.find(|(magic, ..)| start.starts_with(magic));
    found.map_or(Ok(()), |(_, what, way_out)| {
        Err(LogError::Foreign {
            source_name: source.to_owned(),
            what,
            way_out,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_files_are_told_by_their_first_bytes() {
        let said = |start: &[u8]| check("a.bin", start).map_err(|error| error.to_string());
        for (start, words) in [
            (
                b"#ROSBAG V2.0\n".as_slice(),
                "a bag of ROS 1; `rosbags-convert",
            ),
            (b"MATLAB 5.0 MAT-file", "a file of MATLAB; `writetable"),
            (b"PK\x03\x04\x14", "a ZIP archive or a workbook"),
            (b"SQLite format 3\0", "`ros2 bag convert`"),
            (
                b"<?xml version=\"1.0\"?>",
                "XML, as URDFs are; name the log",
            ),
            (b"\x89PNG\r\n\x1a\n", "a picture (PNG); name the file"),
            (b"\xff\xd8\xff\xe0\0\x10JF", "a picture (JPEG); name"),
            (b"GIF89a\x01\0", "a picture (GIF); name"),
            (b"GIF87a\x01\0", "a picture (GIF); name"),
            (
                b"\x7fELF\x02\x01\x01\0",
                "a program or a library (ELF); name",
            ),
        ] {
            let said = said(start).expect_err("no log");
            assert!(
                said.starts_with("a.bin:1: no log is read from ") && said.contains(words),
                "{said}"
            );
        }
        for start in [
            b"time,q1".as_slice(),
            b"# ROSBAG as CSV",
            b"PK,time",
            b"GIF,time",
            b"",
        ] {
            assert_eq!(said(start), Ok(()));
        }
    }
}
