//! What glTF cannot carry, and the document that lists it.

use std::fmt::Write;

use iv_parser::SourcePos;

/// What becomes of the thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Something near it stands in its place.
    Approximated,
    /// Nothing that glTF viewers show stands in its place.
    LeftOut,
}

/// A thing of Inventor that glTF cannot carry as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LossKind {
    /// `Environment` fog.
    Fog,
    /// Ambient light other than Inventor's default.
    AmbientLight,
    /// A light that reaches only a part of the scene.
    LightScope,
    /// A point or spot light's attenuation.
    LightAttenuation,
    /// A spot light's drop-off.
    SpotDropOff,
    /// Back faces lit with the front's normal.
    OneSidedLighting,
    /// Texture models `DECAL` with alpha and `BLEND`.
    TextureModel,
    /// A line width other than one pixel.
    LineWidth,
    /// A dashed line.
    LinePattern,
    /// A point size other than one pixel.
    PointSize,
    /// A camera that does not adapt to the window.
    ViewportMapping,
    /// A camera in a mirrored or sheared frame.
    CameraFrame,
    /// Text that faces the viewer and keeps its size in pixels.
    ScreenText,
}

impl LossKind {
    /// Whether the loss is of a kind that nearly every model has and nobody can act on. Reports
    /// hold it; messages and `--strict` do not.
    #[must_use]
    pub fn is_minor(self) -> bool {
        matches!(self, Self::AmbientLight | Self::OneSidedLighting)
    }

    /// All kinds, in the order of the document.
    pub const ALL: [Self; 13] = [
        Self::Fog,
        Self::AmbientLight,
        Self::LightScope,
        Self::LightAttenuation,
        Self::SpotDropOff,
        Self::OneSidedLighting,
        Self::TextureModel,
        Self::LineWidth,
        Self::LinePattern,
        Self::PointSize,
        Self::ViewportMapping,
        Self::CameraFrame,
        Self::ScreenText,
    ];

    /// Stable short name.
    pub fn code(self) -> &'static str {
        self.row().0
    }

    /// What becomes of it.
    pub fn effect(self) -> Effect {
        self.row().1
    }

    /// What is lost, in one plain sentence without a full stop.
    pub fn text(self) -> &'static str {
        self.row().2
    }

    /// What is written instead, and where the exact values are.
    pub fn instead(self) -> &'static str {
        self.row().3
    }

    fn row(self) -> (&'static str, Effect, &'static str, &'static str) {
        use Effect::{Approximated, LeftOut};
        match self {
            Self::Fog => (
                "fog",
                LeftOut,
                "fog is not shown",
                "type, colour and visibility are in the scene's `extras.iv.environments`",
            ),
            Self::AmbientLight => (
                "ambient-light",
                LeftOut,
                "ambient light or ambient colour is not shown",
                "viewers light the scene in their own way; the values are in the scene's \
                 `extras.iv.environments` and the material's `extras.iv.ambientColor`. Inventor's \
                 defaults are left out too, and not reported",
            ),
            Self::LightScope => (
                "light-scope",
                Approximated,
                "a light reaches shapes that it did not reach in the source",
                "a glTF light reaches the whole scene",
            ),
            Self::LightAttenuation => (
                "light-attenuation",
                Approximated,
                "the brightness of a point or spot light is right at one distance only",
                "glTF light falls with the square of the distance; it is right where the source's \
                 light has fallen to half, at least a quarter of the way to the centre of the \
                 scene's bounds and at most there. The factors are in the light's \
                 `extras.iv.attenuation`, that distance in `extras.iv.referenceDistance`. A radius of \
                 VRML 2 is glTF's `range`, towards which light fades by 1 - (d / range)^4 where \
                 VRML's ends at once",
            ),
            Self::SpotDropOff => (
                "spot-drop-off",
                Approximated,
                "a spot light's edge is softer or harder than in the source",
                "a cosine power becomes a smooth step between two angles, the inner one where the \
                 power has fallen to nine tenths; the rate is in the light's \
                 `extras.iv.dropOffRate`. The ramp of a beam (a photorealism hint) is kept if its \
                 exponent is 2, glTF's; its cones are kept always",
            ),
            Self::OneSidedLighting => (
                "one-sided-lighting",
                Approximated,
                "back faces are lit as if they faced the viewer",
                "without a known vertex ordering Inventor draws both sides and lights them with \
                 the front's normal; glTF turns the normal of a back face",
            ),
            Self::TextureModel => (
                "texture-model",
                Approximated,
                "a texture is mixed with the surface's colour in another way",
                "`DECAL` with alpha and `BLEND` are mixed with the diffuse colour ahead of the \
                 lighting, into a new image; model and blend colour are in the texture's \
                 `extras.iv`",
            ),
            Self::LineWidth => (
                "line-width",
                LeftOut,
                "lines are drawn in the viewer's width",
                "the width is in the material's `extras.iv.lineWidth`",
            ),
            Self::LinePattern => (
                "line-pattern",
                LeftOut,
                "dashed lines are drawn solid",
                "the pattern is in the material's `extras.iv.linePattern`",
            ),
            Self::PointSize => (
                "point-size",
                LeftOut,
                "points are drawn in the viewer's size",
                "the size is in the material's `extras.iv.pointSize`",
            ),
            Self::ViewportMapping => (
                "viewport-mapping",
                Approximated,
                "a camera does not crop or stretch its image",
                "the aspect ratio is written; the mapping is in the camera's \
                 `extras.iv.viewportMapping`",
            ),
            Self::CameraFrame => (
                "camera-frame",
                Approximated,
                "a camera in a mirrored or unevenly scaled frame shows its image undistorted",
                "position, view direction and upright are kept",
            ),
            Self::ScreenText => (
                "screen-text",
                Approximated,
                "text that faces the viewer, in pixels, is flat text in the world",
                "it has the direction and size of one view: that of the first camera, else one \
                 that shows the whole scene, 600 pixels high; the words are in the node's \
                 `extras.iv.string`",
            ),
        }
    }
}

/// One kind of loss in one conversion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// What is lost.
    pub kind: LossKind,
    /// The first occurrence's value; may be empty.
    pub detail: String,
    /// Where the first occurrence is.
    pub pos: SourcePos,
    /// How many shapes, lights or cameras it touches.
    pub count: u32,
}

/// Losses being gathered: the first of each kind, and how many.
#[derive(Default)]
pub(crate) struct Losses {
    found: Vec<Loss>,
}

impl Losses {
    pub(crate) fn add(&mut self, kind: LossKind, pos: SourcePos, detail: impl FnOnce() -> String) {
        match self.found.iter_mut().find(|loss| loss.kind == kind) {
            Some(loss) => loss.count = loss.count.saturating_add(1),
            None => self.found.push(Loss {
                kind,
                detail: detail(),
                pos,
                count: 1,
            }),
        }
    }

    /// In the order of [`LossKind::ALL`].
    pub(crate) fn into_sorted(mut self) -> Vec<Loss> {
        self.found.sort_by_key(|loss| loss.kind);
        self.found
    }
}

/// The text of `docs/LOSSES.md`.
pub fn losses_markdown() -> String {
    let mut out = String::from(
        "# What glTF cannot carry\n\n\
         `ivconvert` reports each of these once, with the place of the first and a count. `ambient-light` and\n`one-sided-lighting`, which nearly every model has, stand in `--report` only and do not count under `--strict`.\n\n\
         | code | effect | what is lost | what is written instead |\n\
         | --- | --- | --- | --- |\n",
    );
    for kind in LossKind::ALL {
        let effect = match kind.effect() {
            Effect::Approximated => "approximated",
            Effect::LeftOut => "left out",
        };
        // Writing to a String does not fail.
        let _ = writeln!(
            out,
            "| `{}` | {effect} | {} | {} |",
            kind.code(),
            kind.text(),
            kind.instead()
        );
    }
    out.push_str(
        "\n## Always so, and not reported\n\n\
         - Inventor adds up light in display colours, glTF in linear ones: single colours agree, \
         the fall of light over a curved surface is steeper.\n\
         - A highlight is a power of a cosine in Inventor and a GGX lobe in glTF. Its width at \
         half height and its height agree, its foot is wider.\n\
         - What a surface mirrors it cannot scatter: a light diffuse colour with a strong specular \
         one is darkened, because no glTF factor exceeds 1. A vertex colour is written as it is, \
         so it is darkened by every highlight.\n\
         - The link of a `WWWAnchor` or `Anchor` cannot be followed in glTF: addresses, description, \
         parameters and `map` are in the node's `extras.iv.link`.\n\
         - Of a Switch the chosen children are written, of levels of detail the finest. With \
         `--alternatives` the others are kept; [OPTIONS.md](OPTIONS.md) says how, and what of them is \
         left out.\n",
    );
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_document_is_up_to_date() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/LOSSES.md");
        if std::env::var_os("UPDATE_DOCS").is_some() {
            std::fs::write(path, losses_markdown()).unwrap();
        }
        let on_disk = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            on_disk == losses_markdown(),
            "run the tests with UPDATE_DOCS=1"
        );
    }

    #[test]
    fn codes_are_distinct_and_the_list_is_in_order() {
        let codes: BTreeSet<_> = LossKind::ALL.iter().map(|kind| kind.code()).collect();
        assert_eq!(codes.len(), LossKind::ALL.len());
        assert!(LossKind::ALL.is_sorted());
    }

    #[test]
    fn a_kind_is_reported_once_with_its_first_place() {
        let at = |line| SourcePos {
            file: 0,
            line,
            column: 1,
        };
        let mut losses = Losses::default();
        losses.add(LossKind::LineWidth, at(7), || "3".into());
        losses.add(LossKind::Fog, at(9), String::new);
        losses.add(LossKind::LineWidth, at(1), || "4".into());
        let got: Vec<_> = losses
            .into_sorted()
            .into_iter()
            .map(|loss| (loss.kind, loss.detail, loss.pos.line, loss.count))
            .collect();
        let want = [
            (LossKind::Fog, String::new(), 9, 1),
            (LossKind::LineWidth, "3".to_owned(), 7, 2),
        ];
        assert_eq!(got, want);
    }
}
