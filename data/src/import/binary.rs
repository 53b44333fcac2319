//! Binary files, known by their first bytes: what they are, and the export that gives a table.

use crate::error::{DataError, Result};

/// Bytes of a file that are looked at.
pub(super) const HEAD: usize = 1 << 16;

struct Binary {
    name: &'static str,
    is: fn(&[u8]) -> bool,
    export: &'static str,
}

fn has(head: &[u8], word: &[u8]) -> bool {
    head.windows(word.len()).any(|part| part == word)
}

fn is_hdf5(head: &[u8]) -> bool {
    has(&head[..head.len().min(520)], b"\x89HDF\r\n\x1a\n")
}

/// All kinds, the most particular first.
const KINDS: [Binary; 15] = [
    Binary {
        name: "MATLAB (.mat)",
        is: |head| head.starts_with(b"MATLAB "),
        export: "in MATLAB: writetable(table(t_s, x_a_mm, y_a_mm), 'run1.csv')",
    },
    Binary {
        name: "DeepLabCut (.h5)",
        is: |head| is_hdf5(head) && (has(head, b"df_with_missing") || has(head, b"block0_values")),
        export: "analyze the video with save_as_csv=True, or in Python: pandas.read_hdf('run1.h5').to_csv('run1.csv')",
    },
    Binary {
        name: "SLEAP (.slp, .h5)",
        is: |head| {
            is_hdf5(head) && (has(head, b"node_names") || has(head, b"pred_points") || has(head, b"videos_json"))
        },
        export: "in SLEAP: File, Export Analysis CSV; or sleap-convert --format analysis.csv",
    },
    Binary {
        name: "netCDF, as movement writes it (.nc)",
        is: |head| head.starts_with(b"CDF") || is_hdf5(head) && (has(head, b"_NCProperties") || has(head, b"_Netcdf4")),
        export: "in Python: movement.io.save_poses.to_dlc_file(data, 'run1.csv'), or data.to_dataframe().to_csv('run1.csv')",
    },
    Binary {
        name: "HDF5",
        is: is_hdf5,
        export: "export CSV in the program that wrote it; in Python: pandas.read_hdf('run1.h5').to_csv('run1.csv')",
    },
    Binary {
        name: "TDMS (LabVIEW)",
        is: |head| head.starts_with(b"TDSm") || head.starts_with(b"TDSh"),
        export: "write a text measurement (.lvm) in LabVIEW; in Python: nptdms.TdmsFile.read('log.tdms').as_dataframe(time_index=True)\
                 .rename(columns=lambda c: c.split('/')[-1].strip('\\'')).rename_axis('time_s').to_csv('log.csv')",
    },
    Binary {
        name: "C3D (motion capture)",
        is: |head| matches!(head, [2..=4, 0x50, ..]),
        export: "export CSV, TSV or TRC in Nexus, QTM or Motive; or open the file in Mokka and export it as ASCII",
    },
    Binary {
        name: "Excel workbook (.xlsx)",
        is: |head| head.starts_with(b"PK\x03\x04") && has(head, b"xl/"),
        export: "save the sheet as \"CSV UTF-8\"",
    },
    Binary {
        name: "zip archive",
        is: |head| head.starts_with(b"PK\x03\x04"),
        export: "unpack it and name the files in it; save a spreadsheet as \"CSV UTF-8\"",
    },
    Binary {
        name: "Excel workbook (.xls)",
        is: |head| head.starts_with(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"),
        export: "save the sheet as \"CSV UTF-8\"",
    },
    Binary {
        name: "Parquet",
        is: |head| head.starts_with(b"PAR1"),
        export: "in Python: pandas.read_parquet('run1.parquet').to_csv('run1.csv', index=False)",
    },
    Binary {
        name: "numpy (.npy)",
        is: |head| head.starts_with(b"\x93NUMPY"),
        export: "in Python: numpy.savetxt('run1.csv', numpy.load('run1.npy'), delimiter=',', header='t_s,x_a_mm,y_a_mm', comments='')",
    },
    Binary { name: "gzip", is: |head| head.starts_with(b"\x1f\x8b"), export: "unpack it: gunzip FILE" },
    Binary {
        name: "ROS bag",
        is: |head| head.starts_with(b"#ROSBAG"),
        export: "rostopic echo -b run.bag -p /TOPIC > run1.csv",
    },
    Binary {
        name: "video",
        is: |head| matches!(head.get(4..8), Some(b"ftyp")) || matches!(head.get(8..12), Some(b"AVI ")),
        export: "track the markers first, for example with Kinovea or DeepLabCut, and import the table",
    },
];

/// Refuses a file that is known to be no text.
///
/// # Errors
/// The name of its format, and the export that gives a table.
pub(super) fn refuse(file: &str, head: &[u8]) -> Result<()> {
    if let Some(kind) = KINDS.iter().find(|kind| (kind.is)(head)) {
        let message = format!("the file is not text: its format is {}", kind.name);
        return Err(DataError::of(file, message, kind.export));
    }
    // Text in UTF-16 has zeros too, and begins with its byte order mark.
    if head.contains(&0) && !head.starts_with(b"\xff\xfe") {
        let help = "export it as text: CSV, TXT or XML";
        return Err(DataError::of(file, "the file is not text", help));
    }
    Ok(())
}
