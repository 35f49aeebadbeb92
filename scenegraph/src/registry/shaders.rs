//! Coin's shader nodes: read and written back; a static model has no use for drawing programs.

macro_rules! shaders {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Appearance {

ShaderProgram: Node, Planned, [],
    "Draws what follows with programs for the graphics card. Coin and TGS addition." {
    shaderObject: MFNode = "[]";
}
VertexShader: ShaderObject, Kept, [SHADER],
    "A program run for each vertex. Coin and TGS addition." {}
FragmentShader: ShaderObject, Kept, [SHADER],
    "A program run for each pixel. Coin and TGS addition." {}
GeometryShader: ShaderObject, Kept, [SHADER],
    "A program run for each point, line or triangle. Coin and TGS addition." {
    inputType: SFEnum = "TRIANGLES_IN" [POINTS_IN, LINES_IN, TRIANGLES_IN];
    outputType: SFEnum = "TRIANGLE_STRIP_OUT" [POINTS_OUT, LINE_STRIP_OUT, TRIANGLE_STRIP_OUT];
    maxEmit: SFInt32 = "8";
}
ShaderParameter1f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFFloat = "0";
}
ShaderParameter2f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFVec2f = "0 0";
}
ShaderParameter3f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFVec3f = "0 0 0";
}
ShaderParameter4f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFVec4f = "0 0 0 0";
}
ShaderParameter1i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFInt32 = "0";
}
ShaderParameter2i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFVec2i32 = "0 0";
}
ShaderParameter3i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFVec3i32 = "0 0 0";
}
ShaderParameter4i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFVec4i32 = "0 0 0 0";
}
ShaderParameterArray1f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFFloat = "0";
}
ShaderParameterArray2f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFVec2f = "0 0";
}
ShaderParameterArray3f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFVec3f = "0 0 0";
}
ShaderParameterArray4f: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFVec4f = "0 0 0 0";
}
ShaderParameterArray1i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFInt32 = "0";
}
ShaderParameterArray2i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFVec2i32 = "0 0";
}
ShaderParameterArray3i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFVec3i32 = "0 0 0";
}
ShaderParameterArray4i: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFVec4i32 = "0 0 0 0";
}
ShaderParameterMatrix: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: SFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
}
ShaderParameterMatrixArray: UniformShaderParameter, Kept, [PARAMETER],
    "A value for a shader. Coin and TGS addition." {
    value: MFMatrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
}
ShaderStateMatrixParameter: UniformShaderParameter, Kept, [PARAMETER],
    "A matrix of the state for a shader. Coin and TGS addition." {
    matrixType: SFEnum = "MODELVIEW" [MODELVIEW, PROJECTION, TEXTURE, MODELVIEW_PROJECTION];
    matrixTransform: SFEnum = "IDENTITY" [IDENTITY, TRANSPOSE, INVERSE, INVERSE_TRANSPOSE];
}

    } } };
}
pub(super) use shaders;
