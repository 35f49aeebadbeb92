//! Textures: embedded images are copied as they are, files are named and left to the consumer.

use std::path::Path;
use std::sync::Arc;

use gltf::json::texture::{Texture as JsonTexture, WrappingMode};
use gltf::json::validation::Checked;
use iv_parser::SourcePos;
use scenegraph::scene::{Texture, TextureId, TextureModel, TextureSource, Wrap};

use super::budget::Budget;
use super::buffers::{Buffers, data_uri, unescaped};
use super::document::Document;
use super::error::ReadError;
use super::iv::Iv;

/// The textures of a file; those of the scene are made when something shows them.
pub(crate) struct Textures<'a> {
    document: &'a Document<'a>,
    beside: &'a Path,
    /// By image of the file.
    images: Vec<Option<TextureSource>>,
    /// By texture of the file: as it is, and mixed.
    known: Vec<[Option<TextureId>; 2]>,
    pub(crate) textures: Vec<Texture>,
    pub(crate) warnings: Vec<String>,
}

impl<'a> Textures<'a> {
    pub(crate) fn new(document: &'a Document<'a>, beside: &'a Path) -> Self {
        Self {
            document,
            beside,
            images: vec![None; document.root.images.len()],
            known: vec![[None; 2]; document.root.textures.len()],
            textures: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Whether the writer mixed the image with the colour of the lit surface it is on.
    pub(crate) fn is_mixed(&self, number: usize) -> bool {
        let source = self.document.root.textures.get(number);
        source.is_some_and(|source| match Iv::of(&source.extras) {
            Some(iv) => matches!(iv.word("model"), Some("DECAL" | "BLEND")),
            None => false,
        })
    }

    /// Whether the image multiplies the colour of the surface, as far as the file says.
    pub(crate) fn is_modulated(&self, number: usize) -> bool {
        let source = self.document.root.textures.get(number);
        let iv = source.and_then(|source| Iv::of(&source.extras));
        iv.is_none_or(|iv| model(&iv) == TextureModel::Modulate)
    }

    /// A texture of the scene; `None`, and a warning, if it has no image.
    pub(crate) fn texture(
        &mut self,
        number: usize,
        mixed: bool,
        buffers: &Buffers,
        budget: &mut Budget,
    ) -> Result<Option<TextureId>, ReadError> {
        let found = self.document.root.textures.get(number);
        let source = found.ok_or(ReadError::broken("texture", number, "it does not exist"))?;
        if let Some(known) = self.known[number][usize::from(mixed)] {
            return Ok(Some(known));
        }
        let iv = Iv::of(&source.extras).unwrap_or_default();
        let image = image_number(source);
        let image = match self.document.root.images.get(image) {
            Some(_) => self.image(image, iv.word("filename"), buffers, budget)?,
            None => None,
        };
        let Some(image) = image else {
            let warning = format!("texture {number} has no image that can be read");
            self.warnings.push(warning);
            return Ok(None);
        };
        let [wrap_s, wrap_t] = sampling(self.document, source);
        let id = TextureId(self.textures.len() as u32);
        self.textures.push(Texture {
            name: source.name.as_deref().map(Into::into),
            source: image,
            wrap_s,
            wrap_t,
            model: if mixed {
                TextureModel::Modulate
            } else {
                model(&iv)
            },
            blend_color_srgb: iv.triple("blendColor", [0.0; 3]),
            pos: SourcePos::default(),
        });
        self.known[number][usize::from(mixed)] = Some(id);
        Ok(Some(id))
    }

    /// The image `number`, which must exist.
    fn image(
        &mut self,
        number: usize,
        file_name: Option<&str>,
        buffers: &Buffers,
        budget: &mut Budget,
    ) -> Result<Option<TextureSource>, ReadError> {
        if let Some(known) = &self.images[number] {
            return Ok(Some(known.clone()));
        }
        let image = &self.document.root.images[number];
        let name: Option<Arc<str>> = file_name.or(image.name.as_deref()).map(Into::into);
        let made = match (&image.buffer_view, &image.uri) {
            (Some(view), _) => {
                let (bytes, _) = buffers.view(self.document, *view)?;
                budget.take(bytes.len() as u64)?;
                let bytes = bytes.into();
                Some(TextureSource::Encoded { bytes, name })
            }
            (None, Some(uri)) => match data_uri(uri) {
                Some(bytes) => bytes.map(|bytes| TextureSource::Encoded {
                    bytes: bytes.into(),
                    name,
                }),
                None => Some(TextureSource::File {
                    name: unescaped(uri).into(),
                    beside: self.beside.to_owned(),
                }),
            },
            (None, None) => None,
        };
        self.images[number].clone_from(&made);
        Ok(made)
    }
}

/// The image of a texture; a number that none has if there is none.
pub(crate) fn image_number(source: &JsonTexture) -> usize {
    let extensions = source.extensions.as_ref();
    let webp = extensions.and_then(|e| e.others.get("EXT_texture_webp")?.get("source")?.as_u64());
    match webp.map(usize::try_from) {
        Some(Ok(webp)) => webp,
        _ => source.source.value(),
    }
}

/// How a texture goes on beyond its edges.
pub(crate) fn sampling(document: &Document, source: &JsonTexture) -> [Wrap; 2] {
    let sampler = source.sampler.and_then(|index| document.root.get(index));
    sampler.map_or([Wrap::Repeat; 2], |sampler| {
        [sampler.wrap_s, sampler.wrap_t].map(wrap)
    })
}

/// What mirrors repeats, which is as near as Inventor comes.
fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        _ => Wrap::Repeat,
    }
}

fn model(iv: &Iv) -> TextureModel {
    match iv.word("model") {
        Some("DECAL") => TextureModel::Decal,
        Some("BLEND") => TextureModel::Blend,
        Some("REPLACE") => TextureModel::Replace,
        _ => TextureModel::Modulate,
    }
}
