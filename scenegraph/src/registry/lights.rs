//! Lights and cameras.

macro_rules! lights {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Light {

DirectionalLight: Light, Full, [LIGHT, DIRECTIONAL_LIGHT],
    "Parallel light." {}
PointLight: Light, Full, [LIGHT, POINT_LIGHT],
    "Light from a point to all sides." {}
SpotLight: Light, Full, [LIGHT, SPOT_LIGHT],
    "Light from a point in a cone; cutOffAngle is the half angle in radians." {}

ShadowDirectionalLight as DirectionalLight: DirectionalLight, Partial, [LIGHT, DIRECTIONAL_LIGHT],
    "A DirectionalLight; its shadows are not kept. Coin addition." {
    shadowMapScene: SFNode = "NULL";
    maxShadowDistance: SFFloat = "-1";
    bboxCenter: SFVec3f = "0 0 0";
    bboxSize: SFVec3f = "-1 -1 -1";
}
ShadowSpotLight as SpotLight: SpotLight, Partial, [LIGHT, SPOT_LIGHT],
    "A SpotLight; its shadows are not kept. Coin addition." {
    shadowMapScene: SFNode = "NULL";
    nearDistance: SFFloat = "-1";
    farDistance: SFFloat = "-1";
}

    } Camera {

PerspectiveCamera: Camera, Full, [CAMERA, PERSPECTIVE],
    "Perspective view; heightAngle is the whole vertical angle in radians." {}
OrthographicCamera: Camera, Full, [CAMERA],
    "Parallel view; height is the whole height of the view." {
    height: SFFloat = "2";
}
FrustumCamera: Camera, Partial, [CAMERA],
    "Perspective view by the sides of the frustum at nearDistance; made symmetric. Coin addition." {
    left: SFFloat = "-0.5";
    right: SFFloat = "0.5";
    top: SFFloat = "0.5";
    bottom: SFFloat = "-0.5";
}
ReversePerspectiveCamera: PerspectiveCamera, Partial, [],
    "Reversed perspective, drawn from behind; taken as a PerspectiveCamera. Coin addition." {
    viewportMapping: SFEnum = "ADJUST_CAMERA" in VIEWPORT_MAPPING;
    position: SFVec3f = "0 0 -10";
    orientation: SFRotation = "0 0 1 3.1415901";
    aspectRatio: SFFloat = "1";
    nearDistance: SFFloat = "-10";
    farDistance: SFFloat = "-1";
    focalDistance: SFFloat = "-6";
    heightAngle: SFFloat = "0.7853982";
}

    } } };
}
pub(super) use lights;
