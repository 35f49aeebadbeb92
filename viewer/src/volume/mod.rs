//! Shadow volumes on the CPU.
