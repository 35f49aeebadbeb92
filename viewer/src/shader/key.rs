//! The key of a generated shader: everything its text depends on, and nothing else.
//!
//! [`ShaderKey::new`] drops what cannot matter, so that two objects share a shader whenever their
//! texts would be equal.

use crate::content::{
    FogUse, LightShape, Look, Primitive, SpotFade, TextureUse, TextureUseModel, WorldLight,
};

/// Which light a pass adds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LightForm {
    /// Parallel rays.
    Directional,
    /// All ways from a point.
    Point,
    /// A cone.
    Spot(SpotForm),
}

/// How the light of a spot weakens towards its edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SpotForm {
    /// It does not.
    Even,
    /// By a power of the cosine.
    Cosine,
    /// From an inner cone on.
    Beam,
}

/// How the shader learns whether a point is in shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ShadowLookup {
    /// It does not ask: there is no shadow, or the stencil test decides.
    None,
    /// A depth map of one view.
    Map,
    /// Six depth maps around the light.
    CubeMap,
    /// A mask with a bit for each sample of a pixel.
    Mask,
    /// What shadow volumes left in the stencil, of one sample a pixel.
    Stencil,
}

/// One light in a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LightKey {
    /// Its shape.
    pub form: LightForm,
    /// It weakens with distance.
    pub is_attenuated: bool,
    /// Where shadows come from.
    pub shadow: ShadowLookup,
}

impl LightKey {
    /// What a shader depends on, of `light`.
    pub fn of(light: &WorldLight, shadow: ShadowLookup) -> Self {
        Self {
            form: match light.shape {
                LightShape::Directional { .. } => LightForm::Directional,
                LightShape::Point { .. } => LightForm::Point,
                LightShape::Spot { fade, .. } => LightForm::Spot(match fade {
                    SpotFade::Cosine { exponent } if exponent > 0.0 => SpotForm::Cosine,
                    SpotFade::Cosine { .. } => SpotForm::Even,
                    SpotFade::Beam { .. } => SpotForm::Beam,
                }),
            },
            is_attenuated: light.attenuation.is_some(),
            shadow,
        }
    }
}

/// What a pass adds to the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Contribution {
    /// Depth alone.
    Depth,
    /// Emission and ambient light, or the whole of what no light reaches; with the first light
    /// where it shines.
    First(Option<LightKey>),
    /// One further light.
    Light(LightKey),
    /// Everything at once, with all lights of the object: for transparent objects.
    All,
}

/// Which terms a shader computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shade {
    /// None: there are no colours.
    Nothing,
    /// The base colour as it is.
    Unlit,
    /// Emission and ambient light alone.
    Constant,
    /// Lights, and what the contribution asks for beside them.
    Lit,
}

/// Everything the text of a surface shader depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ShaderKey {
    /// What the vertices make.
    pub primitive: Primitive,
    /// What it adds.
    pub contribution: Contribution,
    /// What it computes.
    pub shade: Shade,
    /// The normal is turned on back faces.
    pub is_two_sided: bool,
    /// There is a specular term.
    pub is_specular: bool,
    /// All view directions are the same.
    pub is_parallel: bool,
    /// The base colour comes from the vertices.
    pub has_colors: bool,
    /// The texture.
    pub texture: Option<TextureUse>,
    /// The fog.
    pub fog: Option<FogUse>,
    /// A section plane cuts it.
    pub is_cut: bool,
}

impl ShaderKey {
    /// The key for an object's look in a pass; what the text would not show is dropped.
    pub fn new(look: &Look, contribution: Contribution, is_parallel: bool) -> Self {
        if contribution == Contribution::Depth {
            return Self {
                primitive: look.primitive,
                contribution,
                shade: Shade::Nothing,
                is_two_sided: false,
                is_specular: false,
                is_parallel: false,
                has_colors: false,
                texture: None,
                fog: None,
                is_cut: false,
            };
        }
        let blends = contribution == Contribution::All;
        // What no light reaches shows the same in every pass that draws it whole.
        let contribution = match contribution {
            Contribution::First(Some(_)) | Contribution::All if !look.is_lit => {
                Contribution::First(None)
            }
            other => other,
        };
        let shade = match contribution {
            _ if !look.is_lit => Shade::Unlit,
            Contribution::First(None) => Shade::Constant,
            _ => Shade::Lit,
        };
        let is_lit = shade == Shade::Lit;
        let is_specular = is_lit && look.is_specular;
        let shows_base = shade != Shade::Constant
            && look
                .texture
                .is_none_or(|texture| texture.model != TextureUseModel::Replace);
        Self {
            primitive: look.primitive,
            contribution,
            shade,
            is_two_sided: is_lit && look.is_two_sided,
            is_specular,
            is_parallel: is_parallel && is_specular,
            has_colors: look.has_colors && (shows_base || blends),
            // Only REPLACE asks whether the image has an alpha of its own.
            texture: look.texture.map(|texture| TextureUse {
                has_alpha: texture.has_alpha && texture.model == TextureUseModel::Replace,
                ..texture
            }),
            fog: look.fog,
            is_cut: false,
        }
    }

    /// The same where a section plane cuts.
    pub fn cut(self, is_cut: bool) -> Self {
        Self { is_cut, ..self }
    }

    /// Whether it draws all of a surface but the further lights: what is added once is added here.
    pub fn is_first(&self) -> bool {
        !matches!(self.contribution, Contribution::Light(_))
    }

    /// The light of a pass that has one.
    pub fn light(&self) -> Option<LightKey> {
        match self.contribution {
            Contribution::First(light) => light,
            Contribution::Light(light) => Some(light),
            Contribution::Depth | Contribution::All => None,
        }
    }

    /// Whether vertices have normals.
    pub fn has_normals(&self) -> bool {
        self.shade == Shade::Lit
    }

    /// Every key that [`ShaderKey::new`] can give, and those cut that have neither texture nor fog.
    pub fn reachable() -> Vec<Self> {
        let mut keys = std::collections::BTreeSet::new();
        for look in looks() {
            for contribution in contributions(look.is_transparent) {
                // No light is planned for what none reaches.
                if !look.is_lit && matches!(contribution, Contribution::Light(_)) {
                    continue;
                }
                for is_parallel in BOTH {
                    let key = Self::new(&look, contribution, is_parallel);
                    keys.insert(key);
                    // Cutting is the same whatever the colours.
                    if look.texture.is_none() && look.fog.is_none() {
                        keys.insert(key.cut(true));
                    }
                }
            }
        }
        keys.into_iter().collect()
    }
}

const BOTH: [bool; 2] = [false, true];

fn looks() -> Vec<Look> {
    let mut textures = vec![None];
    for model in [
        TextureUseModel::Modulate,
        TextureUseModel::Decal,
        TextureUseModel::Blend,
        TextureUseModel::Replace,
    ] {
        textures.extend(BOTH.map(|has_alpha| Some(TextureUse { model, has_alpha })));
    }
    let fogs = [
        None,
        Some(FogUse::Haze),
        Some(FogUse::Fog),
        Some(FogUse::Smoke),
    ];
    let mut looks = Vec::new();
    for primitive in [Primitive::Triangles, Primitive::Lines, Primitive::Points] {
        for bits in 0..32_u32 {
            let bit = |i: u32| bits >> i & 1 == 1;
            for &texture in &textures {
                for fog in fogs {
                    let is_triangles = primitive == Primitive::Triangles;
                    let is_replaced = texture.is_some_and(|t| t.model == TextureUseModel::Replace);
                    let is_lit = bit(0) && !is_replaced;
                    looks.push(Look {
                        primitive,
                        is_transparent: bit(1),
                        is_lit,
                        is_two_sided: is_lit && is_triangles && bit(2),
                        is_specular: is_lit && bit(3),
                        has_colors: bit(4),
                        texture: texture.filter(|_| is_triangles),
                        fog,
                    });
                }
            }
        }
    }
    looks
}

fn contributions(is_transparent: bool) -> Vec<Contribution> {
    if is_transparent {
        return vec![Contribution::All];
    }
    let mut all = vec![Contribution::Depth, Contribution::First(None)];
    for form in [
        LightForm::Directional,
        LightForm::Point,
        LightForm::Spot(SpotForm::Even),
        LightForm::Spot(SpotForm::Cosine),
        LightForm::Spot(SpotForm::Beam),
    ] {
        for is_attenuated in BOTH {
            if is_attenuated && form == LightForm::Directional {
                continue;
            }
            for shadow in [
                ShadowLookup::None,
                ShadowLookup::Map,
                ShadowLookup::CubeMap,
                ShadowLookup::Mask,
                ShadowLookup::Stencil,
            ] {
                let light = LightKey {
                    form,
                    is_attenuated,
                    shadow,
                };
                all.push(Contribution::First(Some(light)));
                all.push(Contribution::Light(light));
            }
        }
    }
    all
}
