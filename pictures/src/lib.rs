#![doc = include_str!("../README.md")]

pub mod difference;
pub mod image;
pub mod visible;
