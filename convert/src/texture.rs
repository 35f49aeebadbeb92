//! Textures: opened only when something shows them, and stored once however often they are used.

use std::hash::Hasher;
use std::path::Path;

use rustc_hash::{FxHashMap, FxHasher};
use scenegraph::scene::{Scene, Texture, TextureId, TextureModel, TextureSource, Wrap};

use crate::Warning;
use crate::color::unit;
use crate::image::{Alpha, Encoded, Mix, WEBP};
use crate::json::Json;
use crate::options::TextureFormat;

/// The only way to files.
pub trait TextureLoader {
    /// The bytes of the image `name` (as written in the source), looked for first in the folder
    /// `beside`; or why they are not to be had.
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String>;
}

/// Most pixels mixed with colours in one conversion, about ten seconds' work: one texture under
/// many colours is made anew for each.
const MAX_MIXED_PIXELS: u64 = 1 << 28;

/// How a texture and a material make a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// Multiplies the shaded colour.
    Multiply,
    /// Is the surface: no colour, no light.
    Replace,
    /// Stands in place of the diffuse colour, and is lit.
    Diffuse,
}

/// A texture that can be shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shown {
    /// Index of the glTF texture.
    pub(crate) index: u32,
    pub(crate) role: Role,
    pub(crate) alpha: Alpha,
}

struct Stored {
    encoded: Encoded,
    name: Option<String>,
    /// Its index in the output, once something shows it.
    image: Option<u32>,
}

impl Stored {
    fn is_webp(&self) -> bool {
        self.encoded.mime == WEBP
    }
}

struct GltfTexture {
    image: u32,
    sampler: u32,
    source: TextureId,
}

/// All textures of a conversion.
pub(crate) struct Textures<'s> {
    scene: &'s Scene,
    loader: &'s dyn TextureLoader,
    format: TextureFormat,
    stored: Vec<Stored>,
    /// Candidates by hash of their bytes.
    by_content: FxHashMap<u64, Vec<usize>>,
    by_texture: FxHashMap<TextureId, Option<usize>>,
    by_file: FxHashMap<(&'s Path, &'s str), Option<usize>>,
    /// Positions in `stored`, in the order of the output.
    images: Vec<usize>,
    samplers: Vec<(Wrap, Wrap)>,
    textures: Vec<GltfTexture>,
    by_use: FxHashMap<(TextureId, usize), u32>,
    mixed: FxHashMap<(usize, [u8; 3], Mix), usize>,
    mixed_pixels: u64,
    warnings: Vec<Warning>,
}

impl<'s> Textures<'s> {
    pub(crate) fn new(
        scene: &'s Scene,
        loader: &'s dyn TextureLoader,
        format: TextureFormat,
    ) -> Self {
        Self {
            scene,
            loader,
            format,
            stored: Vec::new(),
            by_content: FxHashMap::default(),
            by_texture: FxHashMap::default(),
            by_file: FxHashMap::default(),
            images: Vec::new(),
            samplers: Vec::new(),
            textures: Vec::new(),
            by_use: FxHashMap::default(),
            mixed: FxHashMap::default(),
            mixed_pixels: 0,
            warnings: Vec::new(),
        }
    }

    pub(crate) fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }

    pub(crate) fn image_count(&self) -> usize {
        self.images.len()
    }

    pub(crate) fn has_webp(&self) -> bool {
        self.images
            .iter()
            .any(|&stored| self.stored[stored].is_webp())
    }

    /// Bytes of the image at `index` of the output.
    pub(crate) fn image_bytes(&self, index: usize) -> &[u8] {
        &self.stored[self.images[index]].encoded.bytes
    }

    /// The texture as a surface of colour `diffuse_srgb` shows it; `None` when its image is
    /// missing or unreadable, which is then among the warnings.
    pub(crate) fn show(&mut self, id: TextureId, diffuse_srgb: [f64; 3]) -> Option<Shown> {
        let texture = &self.scene.textures[id.index()];
        let plain = self.image_of(id, texture)?;
        let opaque = self.stored[plain].encoded.alpha == Alpha::Opaque;
        let (role, mix) = match texture.model {
            TextureModel::Modulate => (Role::Multiply, None),
            TextureModel::Replace => (Role::Replace, None),
            // An opaque texture over a colour hides it: OpenGL's GL_DECAL without alpha.
            TextureModel::Decal if opaque => (Role::Replace, None),
            TextureModel::Decal => (Role::Diffuse, Some(Mix::Decal)),
            TextureModel::Blend => {
                let to = bytes_from_srgb(texture.blend_color_srgb);
                (Role::Diffuse, Some(Mix::Blend(to)))
            }
        };
        let shown = match mix {
            None => plain,
            Some(mix) => self.mixed(plain, bytes_from_srgb(diffuse_srgb), mix),
        };
        let alpha = self.stored[shown].encoded.alpha;
        let index = self.use_texture(id, shown);
        Some(Shown { index, role, alpha })
    }

    fn image_of(&mut self, id: TextureId, texture: &'s Texture) -> Option<usize> {
        if let Some(&known) = self.by_texture.get(&id) {
            return known;
        }
        let image = match &texture.source {
            TextureSource::Inline(image) => match Encoded::from_inline(image) {
                Ok(encoded) => Some(self.store(encoded, None)),
                Err(reason) => self.warn("inline image", reason, texture),
            },
            TextureSource::Encoded { bytes, name } => {
                let called = name.as_deref().unwrap_or_default();
                match Encoded::from_file(bytes.to_vec(), called) {
                    Ok(encoded) => Some(self.store(encoded, name.as_deref().map(file_name))),
                    Err(reason) => self.warn("embedded image", reason, texture),
                }
            }
            TextureSource::File { name, beside } => self.file_image(beside, name, texture),
        };
        self.by_texture.insert(id, image);
        image
    }

    fn file_image(&mut self, beside: &'s Path, name: &'s str, by: &Texture) -> Option<usize> {
        if let Some(&known) = self.by_file.get(&(beside, name)) {
            return known;
        }
        let read = self.loader.load(beside, name);
        let image = match read.and_then(|bytes| Encoded::from_file(bytes, name)) {
            Ok(encoded) => Some(self.store(encoded, Some(file_name(name)))),
            Err(reason) => self.warn(name, reason, by),
        };
        self.by_file.insert((beside, name), image);
        image
    }

    /// The image mixed with a colour; the image itself once there have been too many of them.
    fn mixed(&mut self, plain: usize, color_srgb: [u8; 3], mix: Mix) -> usize {
        let key = (plain, color_srgb, mix);
        if let Some(&known) = self.mixed.get(&key) {
            return known;
        }
        let Stored { encoded, name, .. } = &self.stored[plain];
        self.mixed_pixels = self.mixed_pixels.saturating_add(encoded.pixels);
        let affordable = self.mixed_pixels <= MAX_MIXED_PIXELS;
        let mixed = affordable.then(|| encoded.mixed_with(color_srgb, mix));
        let name = name.clone();
        // A damaged file can have a sound header.
        let image = match mixed {
            Some(Ok(encoded)) => self.store(encoded, name),
            Some(Err(_)) | None => plain,
        };
        self.mixed.insert(key, image);
        image
    }

    fn warn(&mut self, name: &str, reason: String, by: &Texture) -> Option<usize> {
        let name = name.to_owned();
        self.warnings.push(Warning {
            name,
            reason,
            pos: by.pos,
        });
        None
    }

    /// Keeps an image unless the same bytes are there already.
    fn store(&mut self, encoded: Encoded, name: Option<String>) -> usize {
        let mut hasher = FxHasher::default();
        hasher.write(&encoded.bytes);
        let candidates = self.by_content.entry(hasher.finish()).or_default();
        let same = |&&i: &&usize| self.stored[i].encoded.bytes == encoded.bytes;
        if let Some(&known) = candidates.iter().find(same) {
            return known;
        }
        candidates.push(self.stored.len());
        self.stored.push(Stored {
            encoded,
            name,
            image: None,
        });
        self.stored.len() - 1
    }

    fn use_texture(&mut self, source: TextureId, stored: usize) -> u32 {
        if let Some(&known) = self.by_use.get(&(source, stored)) {
            return known;
        }
        let images = &mut self.images;
        let known = &mut self.stored[stored];
        let image = match known.image {
            Some(image) => image,
            None => {
                known.encoded.put_into(self.format);
                images.push(stored);
                (images.len() - 1) as u32
            }
        };
        known.image = Some(image);
        let texture = &self.scene.textures[source.index()];
        let wraps = (texture.wrap_s, texture.wrap_t);
        let sampler = self.samplers.iter().position(|&known| known == wraps);
        let sampler = sampler.unwrap_or_else(|| {
            self.samplers.push(wraps);
            self.samplers.len() - 1
        }) as u32;
        let index = self.textures.len() as u32;
        self.textures.push(GltfTexture {
            image,
            sampler,
            source,
        });
        self.by_use.insert((source, stored), index);
        index
    }

    /// `textures`, `images` and `samplers`; `view_of` gives the buffer view of an image.
    pub(crate) fn write(&self, json: &mut Json, extras: bool, view_of: impl Fn(usize) -> u32) {
        json.array_unless_empty("textures", &self.textures, |json, texture| {
            json.object(|json| {
                let source = &self.scene.textures[texture.source.index()];
                if let Some(name) = &source.name {
                    json.key("name").str(name);
                }
                json.key("sampler").u64(texture.sampler.into());
                let image = self.images[texture.image as usize];
                if self.stored[image].is_webp() {
                    json.key("extensions").object(|json| {
                        json.key("EXT_texture_webp")
                            .object(|json| json.key("source").u64(texture.image.into()));
                    });
                } else {
                    json.key("source").u64(texture.image.into());
                }
                if extras {
                    crate::extras::texture(json, source);
                }
            });
        });
        json.array_unless_empty(
            "images",
            self.images.iter().enumerate(),
            |json, (i, &stored)| {
                json.object(|json| {
                    if let Some(name) = &self.stored[stored].name {
                        json.key("name").str(name);
                    }
                    json.key("bufferView").u64(view_of(i).into());
                    json.key("mimeType").str(self.stored[stored].encoded.mime);
                });
            },
        );
        json.array_unless_empty("samplers", &self.samplers, |json, &(s, t)| {
            json.object(|json| {
                json.key("magFilter").u64(LINEAR);
                json.key("minFilter").u64(LINEAR_MIPMAP_LINEAR);
                for (key, wrap) in [("wrapS", s), ("wrapT", t)] {
                    // Repeat is glTF's default.
                    if wrap == Wrap::Clamp {
                        json.key(key).u64(CLAMP_TO_EDGE);
                    }
                }
            });
        });
    }
}

const LINEAR: u64 = 9729;
const LINEAR_MIPMAP_LINEAR: u64 = 9987;
const CLAMP_TO_EDGE: u64 = 33071;

fn bytes_from_srgb(color_srgb: [f64; 3]) -> [u8; 3] {
    color_srgb.map(|v| (unit(v) * 255.0).round() as u8)
}

/// The last part of a path written on any system.
fn file_name(name: &str) -> String {
    let parts = name.rsplit(['/', '\\']);
    parts.into_iter().next().unwrap_or(name).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use iv_parser::SourcePos;
    use scenegraph::scene::Image;
    use std::sync::Arc;

    struct NoFiles;

    impl TextureLoader for NoFiles {
        fn load(&self, _: &Path, _: &str) -> Result<Vec<u8>, String> {
            Err("no files".to_owned())
        }
    }

    #[test]
    fn colours_beyond_the_budget_show_the_texture_as_it_is() {
        let image = Image {
            width: 2,
            height: 1,
            components: 1,
            bytes: vec![0, 100],
        };
        let scene = Scene {
            textures: vec![Texture {
                name: None,
                source: TextureSource::Inline(Arc::new(image)),
                wrap_s: Wrap::Repeat,
                wrap_t: Wrap::Repeat,
                model: TextureModel::Blend,
                blend_color_srgb: [1.0; 3],
                pos: SourcePos::default(),
            }],
            ..Scene::default()
        };
        let mut textures = Textures::new(&scene, &NoFiles, TextureFormat::Keep);
        textures.mixed_pixels = MAX_MIXED_PIXELS - 4;
        let colors = [0.0, 0.25, 0.5, 0.75, 0.25];
        let shown = colors.map(|v| textures.show(TextureId(0), [v; 3]).map(|t| t.index));
        assert_eq!(shown, [0, 1, 2, 2, 1].map(Some));
        assert!(shown.len() > textures.image_count());
    }
}
