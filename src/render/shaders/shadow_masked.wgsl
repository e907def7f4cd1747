// Depth seen from the light, of a surface with holes: they let light through.
//!use corner
//!use material_albedo
//!use material_mask

@fragment
fn fs_shadow(surface: Surface) {
    mask(material_albedo(surface).a);
}
