//! Saved views, `.ivv`, as Lexolights and cadwork's tools exchange them.
//!
//! Text with CRLF: the first line names the version, `CADWORK_IVV_FORMAT_v2` to `_v4`; then one
//! field a line.
//!
//! | field | since | meaning |
//! | --- | --- | --- |
//! | `Type: PerspectiveCamera` | 2 | the only type |
//! | `Position: x y z` | 2 | the eye |
//! | `LookAt: x y z` | 2 | a point in the middle of the image; up is +Z |
//! | `OpeningAngle: a` | 2 | vertical field of view, degrees |
//! | `Rotation: r` | 2 | kept, but as in Lexolights without effect |
//! | `Info: name` | 3 | the view's name |
//! | `EC: 0` or `1` | 4 | kept, without effect; keywords may be written in any case |
//!
//! Numbers have three decimals, so a view through this format is rounded to thousandths of the
//! unit, and its roll about the view direction is lost.

use std::fmt;

use glam::DVec3;

use super::look_at::finite;
use super::{Lens, View};

const HEADER: &str = "CADWORK_IVV_FORMAT_v";

/// What a file of this format holds.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedView {
    /// The eye.
    pub eye: DVec3,
    /// A point in the middle of the image; not the eye.
    pub look_at: DVec3,
    /// Vertical field of view, degrees; between 0 and 180.
    pub opening_angle_deg: f64,
    /// `Rotation`, as written.
    pub rotation: f64,
    /// `Info`; one line.
    pub name: String,
    /// `EC`, if the file has it.
    pub ec: Option<bool>,
}

/// Why a file is not a saved view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IvvError {
    /// From 1; 0 if it is about the whole file.
    pub line: usize,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub hint: &'static str,
}

impl fmt::Display for IvvError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{} ({})", self.message, self.hint),
            line => write!(f, "line {line}: {} ({})", self.message, self.hint),
        }
    }
}

impl std::error::Error for IvvError {}

/// Characters of the file that a message repeats at most.
const QUOTED: usize = 40;

fn error(line: usize, message: &str, text: &str, hint: &'static str) -> IvvError {
    let quoted: String = text.chars().take(QUOTED).collect();
    IvvError {
        line,
        message: format!("{message} `{quoted}`"),
        hint,
    }
}

const HEADER_HINT: &str = "a saved view begins with CADWORK_IVV_FORMAT_v2, CADWORK_IVV_FORMAT_v3 or CADWORK_IVV_FORMAT_v4";

/// Reads a saved view. More is accepted than the format says: any line ends, blanks and a byte
/// order mark before the first line, keywords in any case and order in every version, fields of
/// later versions, unknown fields, text in any encoding that holds ASCII. Of a repeated field the
/// last one counts; `Position`, `LookAt` and `OpeningAngle` must be there.
///
/// # Errors
///
/// [`IvvError`] for the first thing that cannot be understood.
pub fn read(bytes: &[u8]) -> Result<SavedView, IvvError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    // A carriage return is a blank to `trim`; alone it ends a line as well.
    let mut lines = (text
        .split('\n')
        .flat_map(|line| line.trim().split('\r'))
        .zip(1..))
    .map(|(line, number)| (number, line.trim()))
    .filter(|(_, line)| !line.is_empty());
    let (number, first) = lines.next().unwrap_or((0, ""));
    check_header(number, first)?;

    let mut fields = Fields::default();
    for (number, line) in lines {
        fields.read_line(number, line)?;
    }
    fields.finish()
}

fn check_header(number: usize, line: &str) -> Result<(), IvvError> {
    let version = (line.get(..HEADER.len()))
        .filter(|start| start.eq_ignore_ascii_case(HEADER))
        .map(|_| &line[HEADER.len()..]);
    match version {
        Some("2" | "3" | "4") => Ok(()),
        Some(_) => Err(error(number, "unknown version", line, HEADER_HINT)),
        None => Err(error(number, "not a saved view but", line, HEADER_HINT)),
    }
}

/// What has been read so far; numbers with their lines.
#[derive(Default)]
struct Fields {
    eye: Option<DVec3>,
    look_at: Option<(usize, DVec3)>,
    opening_angle_deg: Option<f64>,
    rotation: f64,
    name: String,
    ec: Option<bool>,
}

impl Fields {
    fn read_line(&mut self, number: usize, line: &str) -> Result<(), IvvError> {
        // A line without a colon is no field of any version.
        let Some((key, value)) = line.split_once(':') else {
            return Err(error(number, "no field:", line, "a line is `Name: values`"));
        };
        let value = value.trim();
        match key.trim().to_ascii_lowercase().as_str() {
            "type" if value.eq_ignore_ascii_case("PerspectiveCamera") => {}
            "type" => {
                let hint = "saved views hold a PerspectiveCamera only";
                return Err(error(number, "unknown type", value, hint));
            }
            "position" => self.eye = Some(point(number, value)?),
            "lookat" => self.look_at = Some((number, point(number, value)?)),
            "openingangle" => {
                let [degrees] = numbers(number, value, "an angle is one number, in degrees")?;
                if !(degrees > 0.0 && degrees < 180.0) {
                    let hint = "it must be between 0 and 180 degrees";
                    return Err(error(number, "impossible opening angle", value, hint));
                }
                self.opening_angle_deg = Some(degrees);
            }
            "rotation" => {
                [self.rotation] = numbers(number, value, "a rotation is one number")?;
            }
            "info" => value.clone_into(&mut self.name),
            "ec" => {
                let [ec] = numbers(number, value, "EC is 0 or 1")?;
                self.ec = Some(ec != 0.0);
            }
            _ => {}
        }
        Ok(())
    }

    fn finish(self) -> Result<SavedView, IvvError> {
        let missing = |message: &str, hint| IvvError {
            line: 0,
            message: message.to_owned(),
            hint,
        };
        let eye = (self.eye)
            .ok_or_else(|| missing("no Position", "it needs a line `Position: x y z`"))?;
        let (number, look_at) = (self.look_at)
            .ok_or_else(|| missing("no LookAt", "it needs a line `LookAt: x y z`"))?;
        let opening_angle_deg = self
            .opening_angle_deg
            .ok_or_else(|| missing("no OpeningAngle", "it needs a line `OpeningAngle: degrees`"))?;
        if View::look_at(eye, look_at, opening_angle_deg).is_none() {
            return Err(IvvError {
                line: number,
                message: "LookAt gives no direction".to_owned(),
                hint: "it must be another point than Position",
            });
        }
        Ok(SavedView {
            eye,
            look_at,
            opening_angle_deg,
            rotation: self.rotation,
            name: self.name,
            ec: self.ec,
        })
    }
}

fn point(number: usize, value: &str) -> Result<DVec3, IvvError> {
    numbers(number, value, "a point is three numbers").map(DVec3::from_array)
}

/// The first N numbers of a value; more words are left unread, as Lexolights does.
fn numbers<const N: usize>(
    number: usize,
    value: &str,
    hint: &'static str,
) -> Result<[f64; N], IvvError> {
    let mut words = value.split_whitespace();
    let mut result = [0.0; N];
    for place in &mut result {
        let Some(word) = words.next() else {
            return Err(error(number, "too few numbers:", value, hint));
        };
        *place = finite(word).ok_or_else(|| error(number, "not a number:", word, hint))?;
    }
    Ok(result)
}

/// Least distance from the eye to the point looked at when a view is saved. Each of the two is
/// rounded by at most half a thousandth on each axis, so the direction turns by at most
/// sqrt(3) / 1000 / 10 = 0.00017 radians: a quarter of a pixel at 45 degrees over 1000 pixels.
const LEAST_DISTANCE: f64 = 10.0;

/// What of 0 to 180 degrees, both excluded, three decimals can say.
const ANGLE_RANGE_DEG: (f64, f64) = (0.001, 179.999);

impl SavedView {
    /// A view as it can be saved: `distance` is how far away the point looked at is (what one
    /// turns around), or 10 if less. `None` for an orthographic view.
    #[must_use]
    pub fn new(view: &View, distance: f64, name: &str) -> Option<Self> {
        let Lens::Perspective { tan_half_height } = view.lens else {
            return None;
        };
        // `max` also replaces NaN.
        let distance = distance.max(LEAST_DISTANCE);
        let look_at = view.eye + view.forward() * distance;
        look_at.is_finite().then(|| Self {
            eye: view.eye,
            look_at,
            opening_angle_deg: (2.0 * tan_half_height.atan().to_degrees())
                .clamp(ANGLE_RANGE_DEG.0, ANGLE_RANGE_DEG.1),
            rotation: 0.0,
            name: name.to_owned(),
            ec: None,
        })
    }

    /// What it shows, by [`View::look_at`]. `None` only for values that no file gives.
    #[must_use]
    pub fn view(&self) -> Option<View> {
        View::look_at(self.eye, self.look_at, self.opening_angle_deg)
    }

    /// The file's text: version 4 if there is an `EC`, else version 3, as Lexolights writes.
    #[must_use]
    pub fn write(&self) -> String {
        let version = if self.ec.is_some() { 4 } else { 3 };
        let point = |p: DVec3| format!("{} {} {}", decimal(p.x), decimal(p.y), decimal(p.z));
        let mut lines = vec![
            format!("{HEADER}{version}"),
            String::new(),
            "Type: PerspectiveCamera".to_owned(),
            format!("Position: {}", point(self.eye)),
            format!("LookAt: {}", point(self.look_at)),
            format!("OpeningAngle: {}", decimal(self.opening_angle_deg)),
            format!("Rotation: {}", decimal(self.rotation)),
            // A line break in a name would begin another field.
            format!("Info: {}", self.name.replace(char::is_control, " ").trim()),
        ];
        lines.extend(self.ec.map(|ec| format!("EC: {}", u8::from(ec))));
        lines.push(String::new());
        lines.join("\r\n")
    }
}

/// Three decimals, and no sign on zero.
fn decimal(x: f64) -> String {
    let text = format!("{x:.3}");
    if text == "-0.000" {
        "0.000".to_owned()
    } else {
        text
    }
}

#[cfg(test)]
#[path = "ivv_tests.rs"]
mod tests;
