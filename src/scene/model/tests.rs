//! Models built by code, read back; damaged ones, refused; real ones, where they are.

mod damage;
mod gltf_files;
mod lights_and_materials;
mod plain_files;
mod poses;
mod real_files;
mod support;
