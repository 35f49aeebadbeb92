//! Shadow volumes against brute force in exact integers.

mod extraction;
mod layers;
mod models;
mod oracle;
mod soups;
mod topology;
mod view;
