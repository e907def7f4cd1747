//! Where the joints of a skin have moved its vertices.

use glam::{Affine3A, Mat4};

use super::super::error::Fault;
use super::accessor::Accessor;
use super::document::{Document, look_up};
use super::node::Nodes;

/// From the skin's bind space to the world, a joint each.
pub(super) fn joint_matrices(
    document: &Document,
    skin: usize,
    nodes: &Nodes,
) -> Result<Vec<Affine3A>, Fault> {
    let place = format!("skins[{skin}]");
    let json = document.root.skins.get(skin).ok_or_else(|| {
        let count = document.root.skins.len();
        Fault::new(
            &place,
            format!("is asked for by a node, but the file has {count} skins"),
        )
    })?;
    let mut matrices = json
        .joints
        .iter()
        .map(|&joint| {
            look_up(
                &document.root.nodes,
                joint,
                "node",
                &format!("{place}.joints"),
            )?;
            Ok(nodes.world[joint.value()])
        })
        .collect::<Result<Vec<_>, Fault>>()?;
    if matrices.is_empty() {
        return Err(Fault::new(place, "has no joints; at least one is needed"));
    }
    let Some(inverse_bind) = json.inverse_bind_matrices else {
        return Ok(matrices);
    };
    let accessor = Accessor::open(document, inverse_bind, &place)?;
    if accessor.count < matrices.len() as u64 {
        accessor.expect_count(matrices.len() as u64, &place)?;
    }
    let joints = 0..matrices.len() as u64;
    if accessor.components != 16 {
        let message = "inverse bind matrices must be MAT4";
        return Err(Fault::new(&accessor.place, message));
    }
    accessor.for_each_float_in(joints, |i, numbers| {
        let bind = Affine3A::from_mat4(Mat4::from_cols_slice(numbers));
        matrices[i as usize] *= bind;
        Ok(())
    })?;
    Ok(matrices)
}
