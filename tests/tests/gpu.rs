//! All tests of the renderer, in one binary with one device: a software adapter, so that they
//! give the same pictures wherever they run.

#![allow(clippy::expect_used, clippy::panic)]

mod gpu {
    mod device;
    mod economy;
    mod far;
    mod golden;
    mod mask;
    mod occlusion;
    mod shading;
    mod shadows;
    mod techniques;
}
