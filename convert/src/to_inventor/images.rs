//! What the images of a scene are called in Inventor text, and which files must be written.

use std::sync::Arc;

use scenegraph::scene::{Image, Texture, TextureSource};
use scenegraph::{ImageForm, Loader};

use super::Note;
use crate::image::{decode_file, extension_of};

/// Longest name made of a source's, in bytes; file systems take 255.
const MAX_NAME_BYTES: usize = 200;

/// Images being named.
pub(super) struct Images<'a> {
    loader: &'a dyn Loader,
    existing: &'a dyn Fn(&str) -> Option<Vec<u8>>,
    embed: bool,
    pub(super) files: Vec<(String, Arc<[u8]>)>,
    pub(super) notes: Vec<Note>,
}

impl<'a> Images<'a> {
    pub(super) fn new(
        loader: &'a dyn Loader,
        existing: &'a dyn Fn(&str) -> Option<Vec<u8>>,
        embed: bool,
    ) -> Self {
        Self {
            loader,
            existing,
            embed,
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// What the text says of a texture's image.
    pub(super) fn form(&mut self, texture: &Texture) -> ImageForm {
        let (bytes, name) = match &texture.source {
            TextureSource::Inline(image) => return ImageForm::Inline(Arc::clone(image)),
            TextureSource::Encoded { bytes, name } => (Arc::clone(bytes), name.clone()),
            TextureSource::File { name, beside } => match self.loader.load(beside, name) {
                Ok(loaded) => (loaded.bytes.into(), Some(Arc::clone(name))),
                Err(why) => {
                    self.left_out(name, &why.to_string());
                    return ImageForm::File(name.to_string());
                }
            },
        };
        let name = name.as_deref().unwrap_or_default();
        if self.embed {
            return match inline(&bytes, name) {
                Ok(image) => ImageForm::Inline(Arc::new(image)),
                Err(why) => {
                    self.left_out(name, &why);
                    ImageForm::Missing
                }
            };
        }
        ImageForm::File(self.file(&bytes, name))
    }

    fn left_out(&mut self, name: &str, why: &str) {
        self.notes.push(Note {
            code: "image",
            message: format!("the image `{name}` is left out: {why}"),
            hint: "images are looked for beside the model and in the --search folders",
            is_loss: true,
        });
    }

    /// The name of a file with these bytes: one that is there already, or one to be written.
    pub(super) fn file(&mut self, bytes: &Arc<[u8]>, name: &str) -> String {
        let (stem, extension) = parts(name, bytes);
        for number in 1_u32.. {
            let name = match number {
                1 => format!("{stem}{extension}"),
                _ => format!("{stem}-{number}{extension}"),
            };
            let planned = self.files.iter().find(|(known, _)| *known == name);
            match planned {
                Some((_, known)) if known == bytes => return name,
                Some(_) => continue,
                None => {}
            }
            match (self.existing)(&name) {
                Some(found) if *found == **bytes => return name,
                Some(_) => {}
                None => {
                    self.files.push((name.clone(), Arc::clone(bytes)));
                    return name;
                }
            }
        }
        String::new()
    }
}

/// Stem and extension of a file for an image that its source calls `name`: the last part of a path,
/// without what no file system takes.
fn parts(name: &str, bytes: &[u8]) -> (String, String) {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let legal = |c: char| !(c.is_control() || "<>:\"|?*".contains(c));
    let mut clean: String = last.chars().filter(|&c| legal(c)).collect();
    while clean.len() > MAX_NAME_BYTES {
        clean.pop();
    }
    let clean = clean.trim_matches(|c: char| c == '.' || c.is_whitespace());
    let (stem, extension) = match clean.rsplit_once('.') {
        Some((stem, extension)) if !stem.is_empty() && extension.len() <= 4 => {
            (stem, format!(".{extension}"))
        }
        _ => (clean, format!(".{}", extension_of(bytes))),
    };
    let stem = if stem.is_empty() { "texture" } else { stem };
    (stem.to_owned(), extension)
}

/// Pixels as Inventor holds them: rows from bottom to top.
fn inline(bytes: &[u8], name: &str) -> Result<Image, String> {
    let image = decode_file(bytes, name)?;
    let color = image.color();
    let (width, height) = (image.width(), image.height());
    let (components, bytes) = match (color.has_color(), color.has_alpha()) {
        (false, false) => (1, image.into_luma8().into_raw()),
        (false, true) => (2, image.into_luma_alpha8().into_raw()),
        (true, false) => (3, image.into_rgb8().into_raw()),
        (true, true) => (4, image.into_rgba8().into_raw()),
    };
    if width > u32::from(u16::MAX) || height > u32::from(u16::MAX) {
        return Err("it is larger than Inventor's images can be".to_owned());
    }
    let row = width as usize * usize::from(components);
    let rows = bytes.chunks(row.max(1)).rev();
    Ok(Image {
        width,
        height,
        components,
        bytes: rows.flatten().copied().collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_source_as_far_as_files_can_have_them() {
        for (name, want) in [
            ("wood.png", ("wood", ".png")),
            ("textures/wood.rgb", ("wood", ".rgb")),
            ("C:\\tex\\wood", ("wood", ".png")),
            ("", ("texture", ".png")),
            ("../..", ("texture", ".png")),
            (".png", ("png", ".png")),
            ("a.b.c d?.jpeg", ("a.b.c d", ".jpeg")),
            ("wood.material", ("wood.material", ".png")),
        ] {
            let (stem, extension) = parts(name, b"\x89PNG\r\n\x1a\n");
            assert_eq!((stem.as_str(), extension.as_str()), want, "{name}");
        }
    }
}
