//! Primitives of meshes, as triangles in world space.

use glam::{Affine3A, Mat3A, Vec3A};
use gltf::json;
use gltf::json::mesh::{MorphTarget, Primitive, Semantic};
use gltf::json::validation::Checked;

use super::super::error::Fault;
use super::super::{Loading, normals, tangents};
use super::accessor::Accessor;
use super::document::Document;
use super::material::{Materials, Used};
use super::triangles;
use super::world::{Directions, is_finite, place};
use crate::scene::{Mesh, Vertex};

/// A mesh as one node shows it.
pub(super) struct Instance<'a> {
    /// Index of the node.
    pub node: usize,
    /// From the mesh to the world, where no skin says otherwise.
    pub world: Affine3A,
    /// From the mesh to the world by each joint of its skin.
    pub skin: Option<Vec<Affine3A>>,
    /// Morph weights, where an animation says them.
    pub weights: Option<&'a [f32]>,
}

/// Adds the mesh's triangles to the geometry.
pub(super) fn read_mesh(
    document: &Document,
    mesh: usize,
    instance: &Instance,
    materials: &mut Materials,
    loading: &mut Loading,
) -> Result<(), Fault> {
    let root = &document.root;
    let node = &root.nodes[instance.node];
    let json = root.meshes.get(mesh).ok_or_else(|| {
        let (node, count) = (instance.node, root.meshes.len());
        Fault::new(
            format!("nodes[{node}].mesh"),
            format!("found {mesh}, but the file has {count}"),
        )
    })?;
    let weights = instance
        .weights
        .or(node.weights.as_deref())
        .or(json.weights.as_deref())
        .unwrap_or_default();
    for (index, primitive) in json.primitives.iter().enumerate() {
        let reader = Reader {
            document,
            primitive,
            instance,
            weights,
            place: format!("meshes[{mesh}].primitives[{index}]"),
        };
        if let Some(mut mesh) = reader.read(materials, loading)? {
            mesh.name = node
                .name
                .clone()
                .or_else(|| json.name.clone())
                .unwrap_or_default();
            loading.geometry.meshes.push(mesh);
        }
    }
    Ok(())
}

struct Reader<'a> {
    document: &'a Document,
    primitive: &'a Primitive,
    instance: &'a Instance<'a>,
    weights: &'a [f32],
    place: String,
}

impl<'a> Reader<'a> {
    fn read(
        &self,
        materials: &mut Materials,
        loading: &mut Loading,
    ) -> Result<Option<Mesh>, Fault> {
        let Checked::Valid(mode) = self.primitive.mode else {
            return Err(Fault::new(
                format!("{}.mode", self.place),
                "is none of 0 to 6",
            ));
        };
        let Some(positions) = self.attribute(Semantic::Positions)? else {
            loading
                .warnings
                .say(format!("{} has no positions; it is left out", self.place));
            return Ok(None);
        };
        let count = positions.count;
        let indices = match self.primitive.indices {
            Some(index) => Some(Accessor::open(self.document, index, &self.place)?),
            None => None,
        };
        let budget = &mut loading.budget;
        budget.vertices(&self.place, count)?;
        let Some(mut indices) =
            triangles::read(mode, indices.as_ref(), count, &self.place, budget)?
        else {
            loading
                .warnings
                .say(format!("{} is points or lines; it is left out", self.place));
            return Ok(None);
        };
        if indices.is_empty() {
            return Ok(None);
        }
        let material = materials.get(self.primitive.material, &self.place, loading)?;
        let mut vertices = self.vertices(&positions, material, loading)?;
        if self.to_world(&mut vertices)? {
            for triangle in indices.chunks_exact_mut(3) {
                triangle.swap(1, 2);
            }
        }
        self.complete(&mut vertices, &mut indices, material, loading)?;
        Ok(Some(Mesh {
            name: String::new(),
            vertices,
            indices,
            material: material.index,
        }))
    }

    fn attribute(&self, semantic: Semantic) -> Result<Option<Accessor<'a>>, Fault> {
        self.primitive
            .attributes
            .get(&Checked::Valid(semantic))
            .map(|&index| Accessor::open(self.document, index, &self.place))
            .transpose()
    }

    fn has(&self, semantic: Semantic) -> bool {
        self.primitive
            .attributes
            .contains_key(&Checked::Valid(semantic))
    }

    /// The vertices as the mesh has them, morphed, in its own space.
    fn vertices(
        &self,
        positions: &Accessor,
        material: Used,
        loading: &mut Loading,
    ) -> Result<Vec<Vertex>, Fault> {
        let blank = Vertex {
            position_m: [0.0; 3],
            normal: [0.0; 3],
            tangent: [0.0; 4],
            uv: [0.0; 2],
            color: [1.0; 4],
        };
        let mut vertices = vec![blank; positions.count as usize];
        self.fill(positions, &mut vertices, |vertex, xyz| {
            vertex.position_m = xyz
        })?;
        if let Some(normals) = self.attribute(Semantic::Normals)? {
            self.fill(&normals, &mut vertices, |vertex, xyz| vertex.normal = xyz)?;
        }
        if let Some(tangents) = self.attribute(Semantic::Tangents)? {
            self.fill(&tangents, &mut vertices, |vertex, xyzw| {
                vertex.tangent = xyzw
            })?;
        }
        if let Some(set) = material.uv_set {
            match self.attribute(Semantic::TexCoords(set))? {
                Some(uvs) => self.fill(&uvs, &mut vertices, |vertex, uv| vertex.uv = uv)?,
                None => loading.warnings.say(format!(
                    "{} has no TEXCOORD_{set}, which its material's textures are read at",
                    self.place
                )),
            }
        }
        if let Some(colors) = self.attribute(Semantic::Colors(0))? {
            if colors.components == 3 {
                self.fill(&colors, &mut vertices, |vertex, [r, g, b]| {
                    vertex.color = [r, g, b, 1.0].map(|c| c.clamp(0.0, 1.0));
                })?;
            } else {
                self.fill(&colors, &mut vertices, |vertex, rgba| {
                    vertex.color = rgba.map(|c: f32| c.clamp(0.0, 1.0));
                })?;
            }
        }
        self.morph(&mut vertices)?;
        Ok(vertices)
    }

    fn fill<const N: usize>(
        &self,
        accessor: &Accessor,
        vertices: &mut [Vertex],
        set: impl Fn(&mut Vertex, [f32; N]),
    ) -> Result<(), Fault> {
        accessor.expect_count(vertices.len() as u64, &self.place)?;
        accessor.for_each_float(|i, value| {
            set(&mut vertices[i], value);
            Ok(())
        })
    }

    fn morph(&self, vertices: &mut [Vertex]) -> Result<(), Fault> {
        let targets = self.primitive.targets.iter().flatten();
        for (target, &weight) in targets
            .zip(self.weights)
            .filter(|&(_, &weight)| weight != 0.0)
        {
            let MorphTarget {
                positions,
                normals,
                tangents,
            } = target;
            self.displace(*positions, vertices, weight, |vertex| {
                &mut vertex.position_m
            })?;
            if self.has(Semantic::Normals) {
                self.displace(*normals, vertices, weight, |vertex| &mut vertex.normal)?;
            }
            if self.has(Semantic::Tangents)
                && let Some(index) = *tangents
            {
                let accessor = Accessor::open(self.document, index, &self.place)?;
                self.fill(&accessor, vertices, |vertex, [x, y, z]| {
                    vertex.tangent[0] += x * weight;
                    vertex.tangent[1] += y * weight;
                    vertex.tangent[2] += z * weight;
                })?;
            }
        }
        Ok(())
    }

    fn displace(
        &self,
        accessor: Option<json::Index<json::Accessor>>,
        vertices: &mut [Vertex],
        weight: f32,
        field: impl Fn(&mut Vertex) -> &mut [f32; 3],
    ) -> Result<(), Fault> {
        let Some(index) = accessor else { return Ok(()) };
        let accessor = Accessor::open(self.document, index, &self.place)?;
        self.fill(&accessor, vertices, |vertex, by: [f32; 3]| {
            for (value, by) in field(vertex).iter_mut().zip(by) {
                *value += by * weight;
            }
        })
    }

    /// Puts the vertices into the world, by the skin or the node, and says whether
    /// that turned the surface inside out.
    fn to_world(&self, vertices: &mut [Vertex]) -> Result<bool, Fault> {
        let (mut mirrored, mut upright) = (0_usize, 0_usize);
        let mut count = |mirrors: bool| *(if mirrors { &mut mirrored } else { &mut upright }) += 1;
        match &self.instance.skin {
            Some(joints) if self.has(Semantic::Joints(0)) => {
                let matrices = self.blended(joints, vertices.len())?;
                for (vertex, matrix) in vertices.iter_mut().zip(matrices) {
                    count(place(vertex, &matrix, &Directions::new(&matrix)));
                }
            }
            _ => {
                let directions = Directions::new(&self.instance.world);
                for vertex in vertices.iter_mut() {
                    count(place(vertex, &self.instance.world, &directions));
                }
            }
        }
        match vertices.iter().position(|vertex| !is_finite(vertex)) {
            Some(index) => Err(Fault::new(
                &self.place,
                format!("vertex {index} lies at infinity; look at its node's transform"),
            )),
            None => Ok(mirrored > upright),
        }
    }

    /// Linear blend skinning: the mean of the joints' matrices, by weight, a vertex each.
    fn blended(&self, joints: &[Affine3A], vertices: usize) -> Result<Vec<Affine3A>, Fault> {
        let zero = Affine3A {
            matrix3: Mat3A::ZERO,
            translation: Vec3A::ZERO,
        };
        let mut sums = vec![(zero, 0.0_f32); vertices];
        for set in 0.. {
            let (Some(indices), Some(weights)) = (
                self.attribute(Semantic::Joints(set))?,
                self.attribute(Semantic::Weights(set))?,
            ) else {
                break;
            };
            indices.expect_count(sums.len() as u64, &self.place)?;
            weights.expect_count(sums.len() as u64, &self.place)?;
            let mut of_vertex = vec![[0_u16; 4]; sums.len()];
            indices.for_each_uint(|i, joint| {
                of_vertex[i] = joint.map(|j| u16::try_from(j).unwrap_or(u16::MAX));
                Ok(())
            })?;
            weights.for_each_float(|i, by: [f32; 4]| {
                let (sum, total) = &mut sums[i];
                for (&joint, weight) in of_vertex[i].iter().zip(by).filter(|&(_, w)| w != 0.0) {
                    let Some(joint_matrix) = joints.get(usize::from(joint)) else {
                        let message = format!(
                            "vertex {i} hangs on joint {joint}, but the skin has {} joints",
                            joints.len()
                        );
                        return Err(Fault::new(&self.place, message));
                    };
                    sum.matrix3 += joint_matrix.matrix3 * weight;
                    sum.translation += joint_matrix.translation * weight;
                    *total += weight;
                }
                Ok(())
            })?;
        }
        let mean = |(sum, total): (Affine3A, f32)| {
            if total.abs() < 1e-6 {
                // Hangs on nothing: it goes with the first joint and not to the origin.
                return joints[0];
            }
            Affine3A {
                matrix3: sum.matrix3 * total.recip(),
                translation: sum.translation / total,
            }
        };
        Ok(sums.into_iter().map(mean).collect())
    }

    /// Computes the normals and tangents that the file does not have.
    fn complete(
        &self,
        vertices: &mut Vec<Vertex>,
        indices: &mut [u32],
        material: Used,
        loading: &mut Loading,
    ) -> Result<(), Fault> {
        let has_normals = self.has(Semantic::Normals);
        if !has_normals {
            loading
                .warnings
                .say("there are meshes without normals; they were computed from the triangles");
            let crease_rad = loading.options.crease_rad.unwrap_or(0.0);
            let budget = &mut loading.budget;
            normals::compute(&self.place, vertices, indices, crease_rad, budget)?;
        }
        // Tangents without normals are to be ignored (glTF 2.0, section 3.7.2.1).
        if has_normals && self.has(Semantic::Tangents) {
            return Ok(());
        }
        match loading.geometry.materials[material.index].normal_texture {
            Some(map) => {
                let budget = &mut loading.budget;
                tangents::mikktspace(&self.place, vertices, indices, map.transform, budget)
            }
            None => {
                tangents::any(vertices);
                Ok(())
            }
        }
    }
}
