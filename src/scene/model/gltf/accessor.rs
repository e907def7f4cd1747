//! Arrays of numbers in buffers: packed or interleaved, of any component type,
//! normalised or not, sparse or not.

use std::ops::Range;

use gltf::json;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;

use super::super::error::Fault;
use super::buffers::Region;
use super::document::{Document, look_up};

/// Bytes read from a buffer at once.
const BLOCK_BYTES: u64 = 1 << 18;

/// Takes an element's number and bytes.
type TakeElement<'f> = dyn FnMut(u64, &[u8]) -> Result<(), Fault> + 'f;

/// An accessor whose every element is known to lie within its buffer.
pub(super) struct Accessor<'a> {
    document: &'a Document,
    /// `accessors[7]`, for messages.
    pub place: String,
    /// Elements.
    pub count: u64,
    /// Numbers an element.
    pub components: usize,
    pub component: ComponentType,
    normalized: bool,
    /// `None` where all elements are zero but for the sparse ones.
    packed: Option<Packed>,
    sparse: Option<Sparse>,
}

struct Packed {
    region: Region,
    offset: u64,
    stride: u64,
}

/// Elements that differ from what the buffer view has.
struct Sparse {
    /// Strictly increasing.
    indices: Vec<u32>,
    /// One packed element after another.
    values: Vec<u8>,
}

impl<'a> Accessor<'a> {
    /// Looks up and checks an accessor; `user` is who asks (`meshes[0].primitives[1]`).
    pub fn open(
        document: &'a Document,
        index: json::Index<json::Accessor>,
        user: &str,
    ) -> Result<Self, Fault> {
        let json = look_up(&document.root.accessors, index, "accessor", user)?;
        let place = format!("accessors[{}]", index.value());
        let Checked::Valid(component) = json.component_type else {
            let message = "is none of 5120 to 5123, 5125 and 5126";
            return Err(Fault::new(format!("{place}.componentType"), message));
        };
        let Checked::Valid(type_) = json.type_ else {
            let message = "is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4";
            return Err(Fault::new(format!("{place}.type"), message));
        };
        let mut accessor = Self {
            document,
            place,
            count: json.count.0,
            components: components(type_),
            component: component.0,
            normalized: json.normalized,
            packed: None,
            sparse: None,
        };
        if let Some(view) = json.buffer_view {
            let offset = json.byte_offset.unwrap_or_default().0;
            let place = accessor.place.clone();
            let packed = accessor.packed(view, offset, accessor.count, &place)?;
            accessor.packed = Some(packed);
        } else if json.sparse.is_none() {
            // Zeros throughout, says the standard; in practice data that were lost.
            let message = "has neither `bufferView` nor `sparse`; export the model again";
            return Err(Fault::new(&accessor.place, message));
        }
        if let Some(json) = &json.sparse {
            accessor.sparse = Some(accessor.read_sparse(json)?);
        }
        Ok(accessor)
    }

    /// Bytes of one element.
    fn element_bytes(&self) -> usize {
        self.components * bytes(self.component)
    }

    fn packed(
        &self,
        view: json::Index<json::buffer::View>,
        offset: u64,
        count: u64,
        place: &str,
    ) -> Result<Packed, Fault> {
        let root = &self.document.root;
        let region = Region::of_view(root, &self.document.buffers, view, place)?;
        let element = self.element_bytes() as u64;
        let stride = region.stride.unwrap_or(element);
        if stride < element {
            let message = format!("byteStride is {stride}, but an element has {element} bytes");
            return Err(Fault::new(
                format!("bufferViews[{}]", view.value()),
                message,
            ));
        }
        let end = count
            .checked_sub(1)
            .map_or(Some(0), |steps| {
                steps.checked_mul(stride)?.checked_add(element)
            })
            .and_then(|bytes| bytes.checked_add(offset));
        if end.is_none_or(|end| end > region.length) {
            let message = format!(
                "{count} elements of {element} bytes, {stride} apart, from byte {offset} on, do not \
                 fit into bufferViews[{}], which has {} bytes",
                view.value(),
                region.length
            );
            return Err(Fault::new(place, message));
        }
        Ok(Packed {
            region,
            offset,
            stride,
        })
    }

    fn read_sparse(&self, json: &json::accessor::sparse::Sparse) -> Result<Sparse, Fault> {
        let place = format!("{}.sparse", self.place);
        let Checked::Valid(index_type) = json.indices.component_type else {
            let message = "is none of 5121, 5123 and 5125";
            return Err(Fault::new(
                format!("{place}.indices.componentType"),
                message,
            ));
        };
        let count = json.count.0;
        if count > self.count {
            let message = format!(
                "found {count}, but the accessor has {} elements",
                self.count
            );
            return Err(Fault::new(format!("{place}.count"), message));
        }
        let index_accessor = Accessor {
            document: self.document,
            place: format!("{place}.indices"),
            count,
            components: 1,
            component: index_type.0,
            normalized: false,
            packed: None,
            sparse: None,
        };
        let (view, offset) = (json.indices.buffer_view, json.indices.byte_offset.0);
        let packed = index_accessor.packed(view, offset, count, &index_accessor.place)?;
        let index_accessor = Accessor {
            packed: Some(packed),
            ..index_accessor
        };
        let mut indices: Vec<u32> = Vec::with_capacity(count as usize);
        index_accessor.for_each_uint(|_, [index]| {
            let increases = indices.last().is_none_or(|&last| index > last);
            if !increases || u64::from(index) >= self.count {
                let message = format!(
                    "found {index}; indices must increase and be below {}",
                    self.count
                );
                return Err(Fault::new(&index_accessor.place, message));
            }
            indices.push(index);
            Ok(())
        })?;
        let (view, offset) = (json.values.buffer_view, json.values.byte_offset.0);
        let packed = self.packed(view, offset, count, &format!("{place}.values"))?;
        let mut values = Vec::with_capacity(count as usize * self.element_bytes());
        self.for_each_block(&packed, 0..count, &mut |_, element| {
            values.extend_from_slice(element);
            Ok(())
        })?;
        Ok(Sparse { indices, values })
    }

    /// Calls `each` with the number and bytes of elements, read in blocks.
    fn for_each_block(
        &self,
        packed: &Packed,
        elements: Range<u64>,
        each: &mut TakeElement,
    ) -> Result<(), Fault> {
        let element = self.element_bytes();
        let stride = packed.stride as usize;
        let a_block = (BLOCK_BYTES / packed.stride).max(1);
        let mut block = Vec::new();
        let mut first = elements.start;
        while first < elements.end {
            let count = a_block.min(elements.end - first) as usize;
            block.resize((count - 1) * stride + element, 0);
            let offset = packed.offset + first * packed.stride;
            let buffers = &self.document.buffers;
            buffers
                .read(&packed.region, offset, &mut block)
                .map_err(|error| Fault::unreadable(&self.place, &error))?;
            for i in 0..count {
                each(first + i as u64, &block[i * stride..][..element])?;
            }
            first += count as u64;
        }
        Ok(())
    }

    /// Calls `each` with the number and bytes of elements, sparse ones in place. The
    /// range lies within the accessor.
    fn for_each_element(
        &self,
        elements: Range<u64>,
        mut each: impl FnMut(u64, &[u8]) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let element = self.element_bytes();
        let (indices, values) = match &self.sparse {
            Some(sparse) => (sparse.indices.as_slice(), sparse.values.as_slice()),
            None => (&[][..], &[][..]),
        };
        let mut next = indices.partition_point(|&index| u64::from(index) < elements.start);
        let mut substituting = |i: u64, bytes: &[u8]| {
            if indices
                .get(next)
                .is_some_and(|&index| u64::from(index) == i)
            {
                next += 1;
                each(i, &values[(next - 1) * element..][..element])
            } else {
                each(i, bytes)
            }
        };
        match &self.packed {
            Some(packed) => self.for_each_block(packed, elements, &mut substituting),
            None => {
                let zeros = vec![0_u8; element];
                elements
                    .into_iter()
                    .try_for_each(|i| substituting(i, &zeros))
            }
        }
    }

    /// Calls `each` with every element as real numbers, integers normalised where the
    /// accessor says so. NaN and infinities are faults.
    pub fn for_each_float<const N: usize>(
        &self,
        mut each: impl FnMut(usize, [f32; N]) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        self.check_components(N)?;
        self.for_each_float_in(0..self.count, |i, values| {
            each(i as usize, std::array::from_fn(|k| values[k]))
        })
    }

    /// As [`for_each_float`](Self::for_each_float) for some elements of any width.
    pub fn for_each_float_in(
        &self,
        elements: Range<u64>,
        mut each: impl FnMut(u64, &[f32]) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let (component, normalized) = (self.component, self.normalized);
        let size = bytes(component);
        let mut values = [0.0; 16];
        let values = &mut values[..self.components];
        self.for_each_element(elements, |i, element| {
            for (k, value) in values.iter_mut().enumerate() {
                *value = number(&element[k * size..], component, normalized);
            }
            if let Some(bad) = values.iter().find(|value| !value.is_finite()) {
                let message = format!("element {i} is {bad}; every number must be finite");
                return Err(Fault::new(&self.place, message));
            }
            each(i, values)
        })
    }

    /// Calls `each` with every element as whole numbers.
    pub fn for_each_uint<const N: usize>(
        &self,
        mut each: impl FnMut(usize, [u32; N]) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        self.check_components(N)?;
        let component = self.component;
        if !matches!(
            component,
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32
        ) {
            let message = "found signed or real numbers; 5121, 5123 or 5125 are allowed here";
            return Err(Fault::new(format!("{}.componentType", self.place), message));
        }
        let size = bytes(component);
        self.for_each_element(0..self.count, |i, element| {
            let whole = |k: usize| {
                let mut wide = [0_u8; 4];
                wide[..size].copy_from_slice(&element[k * size..][..size]);
                u32::from_le_bytes(wide)
            };
            each(i as usize, std::array::from_fn(whole))
        })
    }

    fn check_components(&self, wanted: usize) -> Result<(), Fault> {
        if self.components == wanted {
            return Ok(());
        }
        let message = format!(
            "its elements have {} numbers; {wanted} are needed here",
            self.components
        );
        Err(Fault::new(format!("{}.type", self.place), message))
    }

    /// Fails unless it has `count` elements; `user` is who asks.
    pub fn expect_count(&self, count: u64, user: &str) -> Result<(), Fault> {
        if self.count == count {
            return Ok(());
        }
        let message = format!(
            "{} has {} elements; {count} are needed",
            self.place, self.count
        );
        Err(Fault::new(user, message))
    }
}

/// Numbers an element.
fn components(type_: Type) -> usize {
    match type_ {
        Type::Scalar => 1,
        Type::Vec2 => 2,
        Type::Vec3 => 3,
        Type::Vec4 | Type::Mat2 => 4,
        Type::Mat3 => 9,
        Type::Mat4 => 16,
    }
}

/// Bytes a number.
fn bytes(component: ComponentType) -> usize {
    match component {
        ComponentType::I8 | ComponentType::U8 => 1,
        ComponentType::I16 | ComponentType::U16 => 2,
        ComponentType::U32 | ComponentType::F32 => 4,
    }
}

/// The first number in `bytes`; normalised as glTF 2.0, section 3.11, has it.
fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let two = || [bytes[0], bytes[1]];
    let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
    let (value, largest) = match component {
        ComponentType::F32 => return f32::from_le_bytes(four()),
        // Exact to 24 bits, as any reader of floats has it.
        ComponentType::U32 => (u32::from_le_bytes(four()) as f32, u32::MAX as f32),
        ComponentType::I8 => (f32::from(bytes[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(bytes[0]), 255.0),
        ComponentType::I16 => (f32::from(i16::from_le_bytes(two())), 32_767.0),
        ComponentType::U16 => (f32::from(u16::from_le_bytes(two())), 65_535.0),
    };
    if normalized {
        (value / largest).max(-1.0)
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formulas of glTF 2.0's table of normalised integers.
    #[test]
    fn integers_normalise_as_the_standard_has_it() {
        assert_eq!(number(&[0x80], ComponentType::I8, true), -1.0);
        assert_eq!(number(&[0x81], ComponentType::I8, true), -1.0);
        assert_eq!(number(&[127], ComponentType::I8, true), 1.0);
        assert_eq!(number(&[51], ComponentType::U8, true), 0.2);
        assert_eq!(number(&[0xff, 0xff], ComponentType::U16, true), 1.0);
        assert_eq!(number(&[0x00, 0x80], ComponentType::I16, true), -1.0);
        assert_eq!(number(&[0x00, 0x80], ComponentType::I16, false), -32_768.0);
    }
}
