//! Nodes with no effect on the picture.

macro_rules! info {
    ([$next:ident $($rest:ident)*] $($seen:tt)*) => { $next! { [$($rest)*] $($seen)* Information {

Info: Node, Kept, [],
    "A text for readers." {
    string: SFString = "\"<Undefined info>\"";
}
Label: Node, Kept, [],
    "A name for applications." {
    label: SFName = "\"<Undefined label>\"";
}
CacheHint: Node, Kept, [],
    "Caching hints. Coin and TGS addition." {
    memValue: SFFloat = "0.5";
    gfxValue: SFFloat = "0.5";
}
EventCallback: Node, Kept, [],
    "Calls the application on events." {}
Callback: Node, Kept, [],
    "Calls the application during traversal." {}
Listener: Node, Kept, [],
    "The listener of VRML sound. Coin addition." {
    position: SFVec3f = "0 0 0";
    orientation: SFRotation = "0 0 1 0";
    dopplerVelocity: SFVec3f = "0 0 0";
    dopplerFactor: SFFloat = "0";
    gain: SFFloat = "1";
}

    } } };
}
pub(super) use info;
