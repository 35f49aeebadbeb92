//! Lights and cameras.

macro_rules! lights {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Light {

DirectionalLight: Light, Full, [LIGHT, DIRECTIONAL_LIGHT],
    "Parallel light." {}
PointLight: Light, Full, [LIGHT, POINT_LIGHT],
    "Light from a point to all sides." {}
SpotLight: Light, Full, [LIGHT, SPOT_LIGHT],
    "Light from a point in a cone; cutOffAngle is the half angle in radians." {}

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
ReversePerspectiveCamera: PerspectiveCamera, Partial, [CAMERA, PERSPECTIVE],
    "Reversed perspective; taken as a PerspectiveCamera. Coin addition." {}

    } } };
}
pub(super) use lights;
