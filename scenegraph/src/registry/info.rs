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

    } } };
}
pub(super) use info;
