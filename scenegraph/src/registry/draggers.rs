//! Draggers, and the manipulators that show them. A dragger's parts other than those of every
//! dragger are not listed: see `ClassSpec::has_parts`.

macro_rules! draggers {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Dragger {

CenterballDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION],
    "Turns, and moves its centre." {
    center: SFVec3f = "0 0 0";
}
DirectionalLightDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION, TRANSLATION],
    "Aims and moves a parallel light." {}
DragPointDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION],
    "Moves along lines and planes." {}
HandleBoxDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION, SCALE],
    "Moves and scales by a box." {}
JackDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION, TRANSLATION, SCALE],
    "Moves, turns and scales by a jack." {}
PointLightDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION],
    "Moves a light." {}
RotateCylindricalDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION],
    "Turns about an axis by a cylinder." {}
RotateDiscDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION],
    "Turns about an axis by a disc." {}
RotateSphericalDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION],
    "Turns by a sphere." {}
Scale1Dragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, SCALE],
    "Scales along a line." {}
Scale2Dragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, SCALE],
    "Scales in a plane." {}
Scale2UniformDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, SCALE],
    "Scales in a plane evenly." {}
ScaleUniformDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, SCALE],
    "Scales evenly." {}
SpotLightDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION, TRANSLATION],
    "Moves and aims a spotlight and sets its angle." {
    angle: SFFloat = "1";
}
TabBoxDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION, SCALE],
    "Moves and scales by a box with tabs." {}
TabPlaneDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION, SCALE],
    "Moves and scales in a plane." {}
TrackballDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION, SCALE],
    "Turns and scales by a ball." {}
TransformBoxDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION, TRANSLATION, SCALE],
    "Moves, turns and scales by a box." {}
TransformerDragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, ROTATION, TRANSLATION, SCALE],
    "Moves, turns and scales by a box with axes." {
    minDiscRotDot: SFFloat = "0.025";
}
Translate1Dragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION],
    "Moves along a line." {
    minTranslation: SFFloat = "1";
    maxTranslation: SFFloat = "0";
}
Translate2Dragger: Dragger, Kept, [KIT, SEPARATOR, DRAGGER, TRANSLATION],
    "Moves in a plane." {
    minTranslation: SFVec2f = "1 1";
    maxTranslation: SFVec2f = "0 0";
}

    } Manipulator {

TransformManip as Transform: Transform, Partial, [TRANSFORM],
    "A Transform; any dragger shown with it is not drawn." {}
CenterballManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a CenterballDragger shown with it is not drawn." {}
HandleBoxManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a HandleBoxDragger shown with it is not drawn." {}
JackManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a JackDragger shown with it is not drawn." {}
TabBoxManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a TabBoxDragger shown with it is not drawn." {}
TrackballManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a TrackballDragger shown with it is not drawn." {}
TransformBoxManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a TransformBoxDragger shown with it is not drawn." {}
TransformerManip as Transform: TransformManip, Partial, [TRANSFORM],
    "A Transform; a TransformerDragger shown with it is not drawn." {}
DirectionalLightManip as DirectionalLight: DirectionalLight, Partial, [LIGHT, DIRECTIONAL_LIGHT],
    "A DirectionalLight; the dragger shown with it is not drawn." {}
PointLightManip as PointLight: PointLight, Partial, [LIGHT, POINT_LIGHT],
    "A PointLight; the dragger shown with it is not drawn." {}
SpotLightManip as SpotLight: SpotLight, Partial, [LIGHT, SPOT_LIGHT],
    "A SpotLight; the dragger shown with it is not drawn." {}
ClipPlaneManip as ClipPlane: ClipPlane, Planned, [CLIP_PLANE],
    "A ClipPlane; the dragger shown with it is not drawn." {
    draggerPosition: SFVec3f = "0 0 0";
}

    } } };
}
pub(super) use draggers;
