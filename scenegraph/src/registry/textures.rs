//! Textures, their placement and combination: the second half of the appearance family.

macro_rules! textures {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Appearance {

Texture2: Texture, Full, [],
    "Picture from a file or from the field itself; an empty node turns texturing off. \
     enableCompressedTexture is Coin's." {
    filename: SFString = "\"\"";
    image: SFImage = "0 0 0";
    wrapS: SFEnum = "REPEAT" in WRAP;
    wrapT: SFEnum = "REPEAT" in WRAP;
    model: SFEnum = "MODULATE" in TEXTURE_MODEL;
    blendColor: SFColor = "0 0 0";
    enableCompressedTexture: SFBool = "FALSE";
}
Texture3: Texture, Planned, [],
    "Volume texture. Coin and TGS addition." {
    filenames: MFString = "\"\"";
    images: SFImage3 = "0 0 0 0";
    wrapR: SFEnum = "REPEAT" in WRAP;
    wrapS: SFEnum = "REPEAT" in WRAP;
    wrapT: SFEnum = "REPEAT" in WRAP;
    model: SFEnum = "MODULATE" [MODULATE, DECAL, BLEND];
    blendColor: SFColor = "0 0 0";
    enableCompressedTexture: SFBool = "FALSE";
}
TextureCubeMap: Texture, Planned, [],
    "Six pictures round the scene, for reflections. Coin addition." {
    filenames: MFString = "[]";
    imagePosX: SFImage = "0 0 0";
    imageNegX: SFImage = "0 0 0";
    imagePosY: SFImage = "0 0 0";
    imageNegY: SFImage = "0 0 0";
    imagePosZ: SFImage = "0 0 0";
    imageNegZ: SFImage = "0 0 0";
    wrapS: SFEnum = "REPEAT" in WRAP;
    wrapT: SFEnum = "REPEAT" in WRAP;
    model: SFEnum = "MODULATE" in TEXTURE_MODEL;
    blendColor: SFColor = "0 0 0";
}
BumpMap: Node, Planned, [],
    "Height or normal picture. Coin and TGS addition." {
    filename: SFString = "\"\"";
    image: SFImage = "0 0 0";
    wrapS: SFEnum = "REPEAT" in WRAP;
    wrapT: SFEnum = "REPEAT" in WRAP;
}
BumpMapCoordinate: Node, Planned, [],
    "Texture coordinates of a BumpMap. Coin addition." {
    point: MFVec2f = "[]";
}
BumpMapTransform: Node, Planned, [],
    "Placement of a BumpMap. Coin addition." {
    translation: SFVec2f = "0 0";
    rotation: SFFloat = "0";
    scaleFactor: SFVec2f = "1 1";
    center: SFVec2f = "0 0";
}
SceneTexture2: Node, Planned, [],
    "A picture of another scene as texture. Coin addition." {
    wrapS: SFEnum = "REPEAT" [REPEAT, CLAMP, CLAMP_TO_BORDER];
    wrapT: SFEnum = "REPEAT" [REPEAT, CLAMP, CLAMP_TO_BORDER];
    model: SFEnum = "MODULATE" in TEXTURE_MODEL;
    blendColor: SFColor = "0 0 0";
    backgroundColor: SFVec4f = "0 0 0 0";
    size: SFVec2s = "256 256";
    scene: SFNode = "NULL";
    sceneTransparencyType: SFNode = "NULL";
    transparencyFunction: SFEnum = "NONE" [NONE, ALPHA_BLEND, ALPHA_TEST];
    type: SFEnum = "RGBA8" [
        RGBA8, DEPTH, RGBA32F, RGB32F, RGBA16F, RGB16F, R3_G3_B2, RGB, RGB4, RGB5, RGB8, RGB10,
        RGB12, RGB16, RGBA, RGBA2, RGBA4, RGB5_A1, RGB10_A2, RGBA12, RGBA16,
    ];
}
SceneTextureCubeMap: Node, Planned, [],
    "Six pictures of another scene, for reflections. Coin addition." {
    wrapS: SFEnum = "REPEAT" in WRAP;
    wrapT: SFEnum = "REPEAT" in WRAP;
    wrapR: SFEnum = "REPEAT" in WRAP;
    model: SFEnum = "MODULATE" in TEXTURE_MODEL;
    blendColor: SFColor = "0 0 0";
    backgroundColor: SFColor = "0 0 0";
    size: SFVec2s = "256 256";
    scene: SFNode = "NULL";
    transparencyFunction: SFEnum = "NONE" [NONE, ALPHA_BLEND, ALPHA_TEST];
}
Texture2Transform: Node, Full, [],
    "Scales and rotates texture coordinates about `center`, then moves them; cumulative." {
    translation: SFVec2f = "0 0";
    rotation: SFFloat = "0";
    scaleFactor: SFVec2f = "1 1";
    center: SFVec2f = "0 0";
}
Texture3Transform: Node, Partial, [TRANSFORM],
    "As Transform, on texture coordinates; only its effect in the plane. Coin and TGS addition." {}
TextureMatrixTransform: Node, Partial, [],
    "Any matrix on texture coordinates; only its effect in the plane. Coin and TGS addition." {
    matrix: SFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
}
TextureUnit: Node, Partial, [],
    "Chooses the texture unit of what follows; only unit 0 takes effect. Coin and TGS addition." {
    unit: SFInt32 = "0";
    mappingMethod: SFEnum = "IMAGE_MAPPING" [IMAGE_MAPPING, BUMP_MAPPING];
}
TextureCombine: Node, Planned, [],
    "How texture units are mixed. Coin addition." {
    rgbSource: MFEnum = "[]" in COMBINE_SOURCE;
    alphaSource: MFEnum = "[]" in COMBINE_SOURCE;
    rgbOperand: MFEnum = "[]" in COMBINE_OPERAND;
    alphaOperand: MFEnum = "[]" in COMBINE_OPERAND;
    rgbOperation: SFEnum = "MODULATE" in COMBINE_OPERATION;
    alphaOperation: SFEnum = "MODULATE" in COMBINE_OPERATION;
    rgbScale: SFFloat = "1";
    alphaScale: SFFloat = "1";
    constantColor: SFVec4f = "1 1 1 1";
}
TextureScalePolicy: Node, Kept, [],
    "How pictures are brought to the size of the graphics card. Coin addition." {
    policy: SFEnum = "USE_TEXTURE_QUALITY" [
        USE_TEXTURE_QUALITY, SCALE_DOWN, SCALE_UP, FRACTURE,
    ];
    quality: SFFloat = "0.5";
}

    } } };
}
pub(super) use textures;
