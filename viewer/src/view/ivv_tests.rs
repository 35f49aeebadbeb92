//! Saved views: what is read, what is refused and why, what is written.

use super::super::look_at::parse_look_at;
use super::super::tests::v;
use super::*;

const V3: &str = "CADWORK_IVV_FORMAT_v3\r\n\r\nType: PerspectiveCamera\r\n\
    Position: 2600000.125 -1200000.250 3.500\r\nLookAt: 2600000.125 -1199990.250 3.500\r\n\
    OpeningAngle: 45.000\r\nRotation: 0.000\r\nInfo: North side\r\n";

fn saved() -> SavedView {
    SavedView {
        eye: v(2_600_000.125, -1_200_000.25, 3.5),
        look_at: v(2_600_000.125, -1_199_990.25, 3.5),
        opening_angle_deg: 45.0,
        rotation: 0.0,
        name: "North side".to_owned(),
        ec: None,
    }
}

#[test]
fn reads_all_versions_leniently() {
    let body = "Position: 1 2 3\nLookAt: 4 5 6\nOpeningAngle: 60";
    let plain = SavedView {
        eye: v(1.0, 2.0, 3.0),
        look_at: v(4.0, 5.0, 6.0),
        opening_angle_deg: 60.0,
        rotation: 0.0,
        name: String::new(),
        ec: None,
    };
    let header = "CADWORK_IVV_FORMAT_v";
    let rows = [
        (V3.to_owned(), saved()),
        (V3.replace("\r\n", "\n"), saved()),
        (V3.replace("\r\n", "\r"), saved()),
        (format!("\u{feff}\r\n  {V3}"), saved()),
        (V3.replace("_v3", "_v2"), saved()),
        (
            V3.to_uppercase().replace("NORTH SIDE", "North side"),
            saved(),
        ),
        (format!("{header}2\n{body}"), plain.clone()),
        (
            format!("{header}4\n{body} 9 ignored\nEC: 1\nRotation: -7.5\nColour: red"),
            SavedView {
                ec: Some(true),
                rotation: -7.5,
                ..plain.clone()
            },
        ),
        (
            format!("{header}4\nOpeningAngle: 1\n{body}\nec :0\nPOSITION:1e0 2.0 +3"),
            SavedView {
                ec: Some(false),
                ..plain
            },
        ),
    ];
    for (text, expected) in rows {
        assert_eq!(read(text.as_bytes()), Ok(expected), "{text}");
    }
    let mut latin1 = V3.replace("North side", "S?d").into_bytes();
    let place = latin1.iter().position(|&b| b == b'?').unwrap();
    latin1[place] = 0xfc;
    assert_eq!(read(&latin1).unwrap().name, "S\u{fffd}d");
}

#[test]
fn refuses_with_a_line() {
    // What to replace in the text, by what, and the message.
    let rows = [
        (
            "CADWORK_IVV",
            "#Inventor",
            1,
            "not a saved view but `#Inventor_FORMAT_v3`",
        ),
        ("_v3", "_v5", 1, "unknown version `CADWORK_IVV_FORMAT_v5`"),
        ("_v3", "_v33", 1, "unknown version `CADWORK_IVV_FORMAT_v33`"),
        (
            "PerspectiveCamera",
            "Orthographic",
            3,
            "unknown type `Orthographic`",
        ),
        (
            "-1200000.250 3.500",
            "-1200000.250",
            4,
            "too few numbers: `2600000.125 -1200000.250`",
        ),
        ("-1199990.250", "north", 5, "not a number: `north`"),
        ("-1199990.250", "inf", 5, "not a number: `inf`"),
        (
            "-1199990.250",
            "-1200000.250",
            5,
            "LookAt gives no direction",
        ),
        ("45.000", "180", 6, "impossible opening angle `180`"),
        ("45.000", "-1", 6, "impossible opening angle `-1`"),
        ("Rotation: 0.000", "Rotation:", 7, "too few numbers: ``"),
        ("Info: ", "", 8, "no field: `North side`"),
        ("Position", "Place", 0, "no Position"),
        ("LookAt", "Place", 0, "no LookAt"),
        ("OpeningAngle", "Angle", 0, "no OpeningAngle"),
    ];
    for (from, to, line, message) in rows {
        let text = V3.replacen(from, to, 1);
        let error = read(text.as_bytes()).unwrap_err();
        assert_eq!(
            (error.line, error.message.as_str()),
            (line, message),
            "{text}"
        );
        assert!(!error.hint.is_empty());
    }
    for bytes in [&b""[..], b"\r\n\r\n", &[0xff, 0xfe, 0x00], &[0xc3; 3000]] {
        let error = read(bytes).unwrap_err();
        assert!(error.message.starts_with("not a saved view"), "{error}");
        assert!(error.to_string().len() < 400, "{error}");
    }
}

#[test]
fn writes_what_it_reads() {
    assert_eq!(saved().write(), V3);
    let with_ec = SavedView {
        ec: Some(true),
        rotation: -0.0001,
        name: "a\r\nEC: 0".to_owned(),
        ..saved()
    };
    let text = with_ec.write();
    let expected = V3.replace("_v3", "_v4").replace("North side", "a  EC: 0") + "EC: 1\r\n";
    assert_eq!(text, expected);
    assert_eq!(read(text.as_bytes()).unwrap().write(), text);
}

#[test]
fn views_survive_saving() {
    let rows = [
        ("0 -5 0  0 0 0  45", 3.0),
        (
            "2600010.1234 1200020.5 431.75  2600000 1200000 420  30",
            25.0,
        ),
        ("-2600010.1234 -1200020.5 -4 0 0 0 100", f64::NAN),
        ("1 2 30  1 2 0  45", 30.0),
        ("0.1 0.2 0.3  0.1004 0.2003 0.3005  60", 1e-3),
        ("0 0 5  0 1 0  0.0002", 5.0),
    ];
    for (text, distance) in rows {
        let view = parse_look_at(text).unwrap();
        let saved = SavedView::new(&view, distance, "").unwrap();
        let back = read(saved.write().as_bytes()).unwrap().view().unwrap();
        // Half a thousandth on each axis; the bound of the direction is that of LEAST_DISTANCE.
        assert!(
            (back.eye - view.eye).abs().max_element() <= 0.000_500_1,
            "{text}"
        );
        assert!(
            (back.forward() - view.forward()).length() <= 0.000_174,
            "{text}"
        );
        assert!((back.up() - view.up()).length() <= 0.001, "{text}");
        let (Lens::Perspective { tan_half_height: a }, Lens::Perspective { tan_half_height: b }) =
            (back.lens, view.lens)
        else {
            panic!("{text}: not a perspective view");
        };
        assert!((a - b).abs() <= 1e-5 * (1.0 + b * b), "{text}: {a} {b}");
    }
    let flat = View {
        lens: Lens::Orthographic { half_height: 1.0 },
        ..parse_look_at("0 0 5 0 0 0 45").unwrap()
    };
    assert_eq!(SavedView::new(&flat, 5.0, ""), None);
}
