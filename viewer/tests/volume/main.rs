//! Shadow volumes against brute force in exact integers.

mod extraction;
mod oracle;
mod soups;
mod topology;
