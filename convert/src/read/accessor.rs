//! Typed arrays in buffers, with every bound checked when one is opened. Elements are read one by
//! one, so that opening a large array for a few of them costs nothing.

use gltf::json::Index;
use gltf::json::accessor::{self as json, ComponentType};
use gltf::json::validation::Checked;

use super::budget::Budget;
use super::buffers::{Buffers, slice};
use super::document::Document;
use super::error::ReadError;

/// An array whose elements can be read without fail.
#[derive(Clone, Debug)]
pub(crate) struct Accessor<'a> {
    /// `None`: all zeros.
    data: Option<Strided<'a>>,
    sparse: Option<Sparse<'a>>,
    count: usize,
    component: ComponentType,
    normalized: bool,
    /// Components of an element.
    width: usize,
}

/// Elements at equal distances; the last one lies within.
#[derive(Clone, Debug)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

/// Elements that differ from the array's.
#[derive(Clone, Debug)]
struct Sparse<'a> {
    /// Strictly ascending.
    positions: Vec<u32>,
    values: Strided<'a>,
}

impl<'a> Strided<'a> {
    /// `None` if the elements do not lie within.
    fn new(bytes: &'a [u8], offset: u64, stride: usize, size: usize, count: usize) -> Option<Self> {
        let steps = count.saturating_sub(1) as u64;
        let length = match count {
            0 => 0,
            _ => steps.checked_mul(stride as u64)?.checked_add(size as u64)?,
        };
        let bytes = slice(bytes, offset, length)?;
        Some(Self { bytes, stride })
    }

    fn element(&self, i: usize) -> &'a [u8] {
        &self.bytes[i * self.stride..]
    }
}

impl<'a> Accessor<'a> {
    /// Opens an array whose elements have one of `widths` components.
    pub(crate) fn open(
        document: &Document,
        buffers: &'a Buffers,
        index: Index<json::Accessor>,
        widths: &[usize],
        budget: &mut Budget,
    ) -> Result<Self, ReadError> {
        let broken = |reason| ReadError::broken("accessor", index.value(), reason);
        let found = document.root.get(index);
        let source = found.ok_or(broken("it does not exist"))?;
        let Checked::Valid(json::GenericComponentType(component)) = source.component_type else {
            return Err(broken("its component type is unknown"));
        };
        let width = match source.type_ {
            Checked::Valid(json::Type::Scalar) => 1,
            Checked::Valid(json::Type::Vec2) => 2,
            Checked::Valid(json::Type::Vec3) => 3,
            Checked::Valid(json::Type::Vec4) => 4,
            _ => 0,
        };
        if !widths.contains(&width) {
            return Err(broken("its type does not suit its use"));
        }
        let size = width * component.size();
        let count = u32::try_from(source.count.0).map_err(|_| broken("its count is too large"))?;
        let count = count as usize;
        let data = match source.buffer_view {
            None => None,
            Some(view) => {
                let (bytes, stride) = buffers.view(document, view)?;
                let stride = stride.unwrap_or(size);
                if stride < size {
                    return Err(broken("its elements overlap"));
                }
                let offset = source.byte_offset.map_or(0, |offset| offset.0);
                let data = Strided::new(bytes, offset, stride, size, count);
                Some(data.ok_or(broken("it reaches beyond its buffer view"))?)
            }
        };
        let sparse = match &source.sparse {
            None => None,
            Some(sparse) => Some(open_sparse(
                document,
                buffers,
                sparse,
                size,
                count,
                index.value(),
                budget,
            )?),
        };
        Ok(Self {
            data,
            sparse,
            count,
            component,
            normalized: source.normalized,
            width,
        })
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Takes integers for shares of their range, whatever the file says.
    pub(crate) fn into_normalized(mut self) -> Self {
        self.normalized = true;
        self
    }

    /// The element `i`, which must be below the count; components that it lacks are 1.
    pub(crate) fn floats<const N: usize>(&self, i: usize) -> [f32; N] {
        let mut out = [1.0; N];
        let bytes = self.bytes(i);
        let size = self.component.size();
        for (k, slot) in out.iter_mut().take(self.width).enumerate() {
            *slot = match bytes.and_then(|bytes| bytes.get(k * size..)) {
                Some(bytes) => float(bytes, self.component, self.normalized),
                None => 0.0,
            };
        }
        out
    }

    /// The element `i` of unsigned integers; 0 for other types.
    pub(crate) fn unsigned(&self, i: usize) -> u32 {
        self.bytes(i)
            .map_or(0, |bytes| unsigned(bytes, self.component))
    }

    pub(crate) fn is_unsigned(&self) -> bool {
        use ComponentType::{U8, U16, U32};
        matches!(self.component, U8 | U16 | U32)
    }

    fn bytes(&self, i: usize) -> Option<&'a [u8]> {
        if let Some(sparse) = &self.sparse
            && let Ok(at) = sparse.positions.binary_search(&(i as u32))
        {
            return Some(sparse.values.element(at));
        }
        self.data.as_ref().map(|data| data.element(i))
    }
}

fn open_sparse<'a>(
    document: &Document,
    buffers: &'a Buffers,
    source: &json::sparse::Sparse,
    size: usize,
    of: usize,
    accessor: usize,
    budget: &mut Budget,
) -> Result<Sparse<'a>, ReadError> {
    let broken = |reason| ReadError::broken("accessor", accessor, reason);
    let Checked::Valid(json::IndexComponentType(component)) = source.indices.component_type else {
        return Err(broken("its sparse indices have an unknown type"));
    };
    let count = usize::try_from(source.count.0).unwrap_or(usize::MAX);
    if count > of {
        return Err(broken("it has more sparse elements than elements"));
    }
    let beyond = || broken("its sparse elements reach beyond their buffer view");
    let (bytes, _) = buffers.view(document, source.indices.buffer_view)?;
    let offset = source.indices.byte_offset.0;
    let indices = Strided::new(bytes, offset, component.size(), component.size(), count);
    let indices = indices.ok_or_else(beyond)?;
    let (bytes, _) = buffers.view(document, source.values.buffer_view)?;
    let values = Strided::new(bytes, source.values.byte_offset.0, size, size, count);
    let values = values.ok_or_else(beyond)?;
    budget.take(4 * count as u64)?;
    let positions: Vec<u32> = (0..count)
        .map(|i| unsigned(indices.element(i), component))
        .collect();
    let ascending = positions.is_sorted_by(|a, b| a < b);
    if !ascending || positions.last().is_some_and(|&last| last as usize >= of) {
        return Err(broken("its sparse indices do not ascend within it"));
    }
    Ok(Sparse { positions, values })
}

fn head<const N: usize>(bytes: &[u8]) -> [u8; N] {
    bytes.first_chunk().copied().unwrap_or([0; N])
}

fn unsigned(bytes: &[u8], component: ComponentType) -> u32 {
    match component {
        ComponentType::U8 => u8::from_le_bytes(head(bytes)).into(),
        ComponentType::U16 => u16::from_le_bytes(head(bytes)).into(),
        ComponentType::U32 => u32::from_le_bytes(head(bytes)),
        ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => 0,
    }
}

/// One component; the shares of a range are those of the glTF specification, 3.6.2.2.
fn float(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, most) = match component {
        ComponentType::F32 => return f32::from_le_bytes(head(bytes)),
        ComponentType::I8 => (f32::from(i8::from_le_bytes(head(bytes))), 127.0),
        ComponentType::U8 => (f32::from(u8::from_le_bytes(head(bytes))), 255.0),
        ComponentType::I16 => (f32::from(i16::from_le_bytes(head(bytes))), 32767.0),
        ComponentType::U16 => (f32::from(u16::from_le_bytes(head(bytes))), 65535.0),
        ComponentType::U32 => (u32::from_le_bytes(head(bytes)) as f32, u32::MAX as f32),
    };
    if normalized {
        (value / most).max(-1.0)
    } else {
        value
    }
}
