//! Lights and cameras.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use iv_parser::NodeId as TreeId;
use scenegraph::scene::{Light, LightKind, Projection};

use super::text::{tidy_triple, triple_text};
use super::{No, Patcher};

impl Patcher<'_, '_, '_> {
    pub(super) fn light(&mut self, at: usize, to: usize) -> Result<(), No> {
        let (Some(Some((old, _))), Some(Some((new, _)))) =
            (self.was.objects.lights.get(at), self.is.lights.get(to))
        else {
            return Err("a light has another type".to_owned());
        };
        let source = self.scene.lights.get(at).ok_or("a light has no origin")?;
        let node = self.node_at(source.placement.pos)?;
        let strength = source.intensity;
        if old.color_srgb != new.color_srgb {
            let [r, g, b] = new.color_srgb.map(|v| v as f32);
            self.set(node, "color", &format!("{r} {g} {b}"))?;
        }
        if old.intensity != new.intensity {
            if old.intensity <= 0.0 {
                return Err("a light without strength was given some".to_owned());
            }
            // What glTF's strength is made of besides stays as it is.
            let value = strength * new.intensity / old.intensity;
            self.set(node, "intensity", &format!("{}", value as f32))?;
        }
        self.cone(node, old, new)
    }

    fn cone(&mut self, node: TreeId, old: &Light, new: &Light) -> Result<(), No> {
        let angles = |light: &Light| match light.kind {
            LightKind::Spot {
                drop_off_rate,
                cut_off_angle_rad,
                ..
            } => Some([drop_off_rate, cut_off_angle_rad]),
            _ => None,
        };
        if std::mem::discriminant(&old.kind) != std::mem::discriminant(&new.kind) {
            return Err("a light has another type".to_owned());
        }
        let (Some(old), Some(new)) = (angles(old), angles(new)) else {
            return Ok(());
        };
        for (i, field) in ["dropOffRate", "cutOffAngle"].into_iter().enumerate() {
            if old[i] != new[i] {
                if self.is_vrml2() && field == "dropOffRate" {
                    return Err("the inner cone of a light was edited".to_owned());
                }
                self.set(node, field, &format!("{}", new[i] as f32))?;
            }
        }
        Ok(())
    }

    /// `world_from_light` is the frame of the light's glTF node.
    pub(super) fn move_light(&mut self, i: usize, world_from_light: DAffine3) -> Result<(), No> {
        let light = &self.scene.lights[i];
        let node = self.node_at(light.placement.pos)?;
        let local_from_light = light.placement.world_from_local.inverse() * world_from_light;
        let location = tidy_triple(local_from_light.translation);
        let direction = local_from_light
            .transform_vector3(DVec3::NEG_Z)
            .normalize_or(DVec3::NEG_Z);
        if !location.is_finite() {
            return Err("a light stands in a frame without an inverse".to_owned());
        }
        if !matches!(light.kind, LightKind::Directional { .. }) {
            self.set(node, "location", &triple_text(location))?;
        }
        if !matches!(light.kind, LightKind::Point { .. }) {
            self.set(node, "direction", &triple_text(tidy_triple(direction)))?;
        }
        Ok(())
    }

    pub(super) fn move_camera(&mut self, i: usize, world_from_camera: DAffine3) -> Result<(), No> {
        let camera = &self.scene.cameras[i];
        let node = self.node_at(camera.placement.pos)?;
        let local = camera.placement.world_from_local.inverse() * world_from_camera;
        let columns = [
            local.matrix3.x_axis,
            local.matrix3.y_axis,
            local.matrix3.z_axis,
        ];
        if !local.is_finite() || columns.iter().any(|c| c.length() == 0.0) {
            return Err("a camera stands in a frame without an inverse".to_owned());
        }
        let [x, y, z] = columns.map(DVec3::normalize);
        let rotation = DQuat::from_mat3(&DMat3::from_cols(x, y, z));
        let (axis, angle_rad) = rotation.normalize().to_axis_angle();
        self.set(
            node,
            "position",
            &triple_text(tidy_triple(local.translation)),
        )?;
        let axis = triple_text(tidy_triple(axis));
        self.set(node, "orientation", &format!("{axis} {angle_rad}"))
    }

    pub(super) fn camera(&mut self, at: usize, to: usize) -> Result<(), No> {
        let (Some(Some(old)), Some(Some(new))) =
            (self.was.objects.cameras.get(at), self.is.cameras.get(to))
        else {
            return Err("a camera has another type".to_owned());
        };
        let source = self.scene.cameras.get(at).ok_or("a camera has no origin")?;
        let node = self.node_at(source.placement.pos)?;
        let frame = source.placement.world_from_local;
        let unit_length = frame
            .transform_vector3(source.orientation * DVec3::NEG_Z)
            .length();
        let unit_height = frame
            .transform_vector3(source.orientation * DVec3::Y)
            .length();
        match (old.projection, new.projection) {
            (
                Projection::Perspective {
                    height_angle_rad: a,
                },
                Projection::Perspective {
                    height_angle_rad: b,
                },
            ) if a != b => {
                let field = match self.is_vrml2() {
                    true => "fieldOfView",
                    false => "heightAngle",
                };
                self.set(node, field, &format!("{b}"))?;
            }
            (Projection::Orthographic { height: a }, Projection::Orthographic { height: b })
                if a != b =>
            {
                self.set(node, "height", &format!("{}", b / unit_height))?;
            }
            (Projection::Perspective { .. }, Projection::Perspective { .. })
            | (Projection::Orthographic { .. }, Projection::Orthographic { .. }) => {}
            _ => return Err("a camera has another type".to_owned()),
        }
        let rows = [
            (
                "nearDistance",
                old.near_distance,
                new.near_distance,
                unit_length,
            ),
            (
                "farDistance",
                old.far_distance,
                new.far_distance,
                unit_length,
            ),
            ("aspectRatio", old.aspect_ratio, new.aspect_ratio, 1.0),
        ];
        for (field, old, new, unit) in rows {
            if old != new {
                if self.is_vrml2() {
                    return Err("the range or aspect of a camera was edited".to_owned());
                }
                self.set(node, field, &format!("{}", new / unit))?;
            }
        }
        Ok(())
    }
}
