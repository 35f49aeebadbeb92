//! `--info --json`: one object for each input.

use convert::command::json::diagnostics;
use geometry::bounds::Aabb;
use serde_json::{Value, json};

use super::measure::Amount;
use super::{Content, Info, TextureKind, format_name};

/// The object of one input; `content` is null if it could not be read.
pub fn document(info: &Info) -> Value {
    json!({
        "path": info.path.display().to_string(),
        "status": if info.failure.is_some() { "failed" } else { "read" },
        "error": info.failure,
        "bytes": info.bytes,
        "diagnostics": diagnostics(&info.diagnostics),
        "content": info.content.as_ref().map(content),
    })
}

fn content(content: &Content) -> Value {
    let file = |(name, header)| json!({ "name": name, "format": format_name(header) });
    let [directional, point, spot] = content.lights;
    let [perspective, orthographic] = content.cameras;
    json!({
        "files": content.files.iter().map(|(n, h)| file((n, h))).collect::<Value>(),
        "nodes": { "total": content.node_count(), "by_class": content.classes },
        "meshes": amount(content.meshes),
        "triangles": amount(content.triangles),
        "lines": amount(content.lines),
        "points": amount(content.points),
        "materials": content.materials,
        "textures": content.textures.iter().map(texture).collect::<Value>(),
        "lights": { "directional": directional, "point": point, "spot": spot },
        "cameras": { "perspective": perspective, "orthographic": orthographic },
        "bounds": bounds(&content.bounds),
    })
}

fn amount(amount: Amount) -> Value {
    json!({ "unique": amount.unique, "instanced": amount.instanced })
}

fn texture(texture: &TextureKind) -> Value {
    match texture {
        TextureKind::File(name) => json!({ "file": name }),
        TextureKind::Inline(width, height, components, bytes) => json!({
            "width": width,
            "height": height,
            "components": components,
            "bytes": bytes,
        }),
    }
}

/// Null if nothing is drawn.
fn bounds(bounds: &Aabb) -> Option<Value> {
    let value = json!({ "min": bounds.min.to_array(), "max": bounds.max.to_array() });
    (!bounds.is_empty()).then_some(value)
}
