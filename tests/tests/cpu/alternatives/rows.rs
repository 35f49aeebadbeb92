//! What models have besides what they show, one row a rule.

/// A model and what is kept of it.
pub struct Row {
    pub name: &'static str,
    /// What stands behind the header of Inventor 2.1, or a whole file.
    pub text: &'static str,
    /// Each instance as its name, its x in the world, and the marks of the groups around it from
    /// outside to inside: `h` hidden, `>10` a level from the distance 10 on, `<10` one below 10
    /// square pixels, `l` one without limit.
    pub instances: &'static [&'static str],
    /// Each variant and the instances that have another material in it.
    pub variants: &'static [&'static str],
    /// Codes of notes and warnings, sorted.
    pub remarks: &'static [&'static str],
}

/// Names and colours that the reader of others is asked for; see `readers_find_what_is_kept`.
pub const HOUSE: &str = "Separator {
    DirectionalLight { }
    DEF Doors Switch { whichChild 1
        DEF Open Separator { Translation { translation 3 0 0 } PointLight { } Cube { } }
        DEF Shut Group { Cube { } }
        DEF Half Cone { }
    }
    DEF Paint Switch { whichChild 0
        DEF Red Material { diffuseColor 1 0 0 }
        DEF Blue Group { Material { diffuseColor 0 0 1 } }
        Material { diffuseColor 0 1 0 }
    }
    Separator { Translation { translation 0 5 0 } DEF Body Cube { } }
    Separator { Translation { translation 0 9 0 } Material { diffuseColor 1 1 1 } DEF White Cube { } }
    DEF Tree LOD { range [ 10 50 ]
        DEF Fine Separator { DEF Stem Sphere { } Translation { translation 2 0 0 } DEF Crown Sphere { } }
        DEF Coarse Cube { }
        Separator { }
    }
    LevelOfDetail { screenArea [ 10000 ]
        DEF Cone Cone { }
        DEF Rough Separator { LOD { range 5 DEF Inner Cube { } DEF Last Cone { } } }
    }
}";

pub const ROWS: &[Row] = &[
    Row {
        name: "what a hidden child sets does not leak, what the shown one sets does",
        text: "Translation { translation 1 0 0 } Switch { whichChild 1
            Group { Translation { translation 10 0 0 } DEF A Cube { } }
            Group { Translation { translation 100 0 0 } DEF B Cube { } }
            DEF C Cube { } }
            DEF D Cube { }",
        instances: &["A 11 h", "B 101", "C 1 h", "D 101"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "a Switch hides all by default, and nothing with -3",
        text: "Switch { DEF A Cube { } } Switch { whichChild -3 DEF B Cube { } DEF C Cube { } }",
        instances: &["A 0 h", "B 0", "C 0"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "a choice beyond the children hides all",
        text: "Switch { whichChild 7 DEF A Cube { } DEF B Cube { } }",
        instances: &["A 0 h", "B 0 h"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "hidden parts have hidden parts",
        text: "Switch { Switch { whichChild 0 DEF A Cube { } DEF B Cube { } } }",
        instances: &["A 0 h", "B 0 hh"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "an inherited choice is that of the child it is in",
        text: "Switch { whichChild 1
            Group { DEF S Switch { whichChild -2 DEF A Cube { } DEF B Cube { } } }
            Group { USE S } }",
        instances: &["A 0 h", "B 0 hh", "A 0 h", "B 0"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "a Blinker moves, and hides nothing for good",
        text: "Blinker { DEF A Cube { } DEF B Cube { } }",
        instances: &["A 0"],
        variants: &[],
        remarks: &["hidden", "hidden"],
    },
    Row {
        name: "lights and cameras of hidden parts are left out",
        text: "Switch { Group { PointLight { } PerspectiveCamera { } DEF A Cube { } } } DEF B Cube { }",
        instances: &["A 0 h", "B 0"],
        variants: &[],
        remarks: &["hidden", "kept"],
    },
    Row {
        name: "a hidden child that only moves what follows is left out",
        text: "Switch { whichChild 0 Group { } Translation { translation 9 0 0 } } DEF A Cube { }",
        instances: &["A 0"],
        variants: &[],
        remarks: &["hidden"],
    },
    Row {
        name: "levels by distance, the last of which shows nothing",
        text: "Separator { Scale { scaleFactor 2 2 2 } LOD { range [ 10 20 ]
            Group { DEF A Cube { } DEF B Cube { } } DEF C Cube { } Separator { } } }",
        instances: &["A 0", "B 0", "C 0 >10"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "levels by area, one without a limit",
        text: "LevelOfDetail { screenArea 400 DEF A Cube { } DEF B Cube { } DEF C Cube { } }",
        instances: &["A 0", "B 0 <400", "C 0 l"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "VRML 2 measures levels in their own frame",
        text: "#VRML V2.0 utf8
            Transform { scale 2 2 2 children LOD { range [ 10 ] level [
                DEF A Shape { geometry Box { } } DEF B Shape { geometry Box { } } ] } }",
        instances: &["A 0", "B 0 >20"],
        variants: &[],
        remarks: &["kept"],
    },
    Row {
        name: "a hidden light of VRML 2 lights nothing, a shown one its group",
        text: "#VRML V2.0 utf8
            Switch { whichChoice 0 choice [
                Group { children [ DEF A Shape { geometry Box { } } ] }
                DirectionalLight { }
                PointLight { }
                DEF B Shape { geometry Box { } } ] }",
        instances: &["A 0", "B 0 h"],
        variants: &[],
        remarks: &["hidden", "hidden", "kept"],
    },
    Row {
        name: "looks become variants with the names of the children, also of what is nested deeper",
        text: "DEF Paint Switch { whichChild 0
                DEF Red Material { diffuseColor 1 0 0 }
                Group { DEF Blue Material { diffuseColor 0 0 1 } } }
            DEF A Cube { } Separator { Group { DEF B Cube { } } }
            Material { diffuseColor 1 1 1 } DEF C Cube { }",
        instances: &["A 0", "B 0", "C 0"],
        variants: &["Red:", "Paint 1: A B"],
        remarks: &["kept"],
    },
    Row {
        name: "a Separator ends variants",
        text: "Separator { Switch { whichChild 0 DEF R BaseColor { rgb 1 0 0 } DEF G BaseColor { rgb 0 1 0 } }
            DEF A Cube { } } DEF B Cube { }",
        instances: &["A 0", "B 0"],
        variants: &["R:", "G: A"],
        remarks: &["kept"],
    },
    Row {
        name: "a colour behind a Switch keeps the rest of the look",
        text: "Switch { whichChild 0 Material { shininess 0.1 } Material { shininess 0.9 } }
            BaseColor { rgb 1 1 0 } DEF A Cube { }",
        instances: &["A 0"],
        variants: &["Switch 0:", "Switch 1: A"],
        remarks: &["kept"],
    },
    Row {
        name: "each variant changes one Switch; names are told apart",
        text: "Switch { DEF X Material { diffuseColor 1 0 0 } }
            Switch { whichChild 0 LightModel { } DEF X LightModel { model BASE_COLOR } }
            DEF A Cube { }",
        instances: &["A 0"],
        variants: &["X: A", "Switch none:", "Switch 0:", "X 2: A"],
        remarks: &["kept"],
    },
    Row {
        name: "looks that change nothing are no variants",
        text: "Switch { whichChild 0 Material { } Material { } } DEF A Cube { }
            Switch { whichChild 0 Material { } Material { diffuseColor 1 0 0 } }",
        instances: &["A 0"],
        variants: &[],
        remarks: &[],
    },
    Row {
        name: "a texture can be taken away, but not put on a mesh that has no place for it",
        text: "DEF T Texture2 { image 1 1 1 9 }
            Switch { whichChild 0 USE T Texture2 { } } DEF A Cube { }
            Switch { whichChild 0 Texture2 { } USE T } DEF B Cube { }",
        instances: &["A 0", "B 0"],
        variants: &["T:", "Switch 1: A"],
        remarks: &["hidden", "kept"],
    },
    Row {
        name: "colours of vertices are the mesh's",
        text: "Switch { whichChild 0 Material { }
                Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } }
            MaterialBinding { value PER_PART } DEF A Cube { }",
        instances: &["A 0"],
        variants: &[],
        remarks: &["hidden"],
    },
    Row {
        name: "hidden parts have variants too",
        text: "Switch { whichChild 0 Material { } Material { diffuseColor 1 0 0 } }
            Switch { DEF A Cube { } }",
        instances: &["A 0 h"],
        variants: &["Switch 0:", "Switch 1: A"],
        remarks: &["kept", "kept"],
    },
    Row {
        name: "text in pixels keeps its size beside a large hidden part",
        text: "DEF A Cube { } Switch { DEF B Cube { width 1000 } } DEF C Text2 { string \"x\" }",
        instances: &["A 0", "B 0 h", "C 0"],
        variants: &[],
        remarks: &["kept"],
    },
];
