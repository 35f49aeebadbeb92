//! Connected components of a mesh: whether they are closed, and which winding numbers occur
//! around them. Not a repair of anything.
//!
//! A component is closed when every edge is run as often one way as the other, whatever its
//! valence. Then each point of space off its surface has a winding number: how often the
//! surface is left, less how often it is entered, on any way from the point to infinity.
//!
//! A range of the winding numbers is certified with a centre `c`: if all triangles have `c` on
//! their inner side or in their plane, then on every ray from `c` the winding number only
//! falls, from that of `c` to 0. (If all have it on their outer side, it only rises.) So
//! spheres, boxes, cylinders and all convex and star-shaped solids have a range. A solid that
//! is folded through itself may have none, and neither has one that is just not star-shaped.

use geometry::bounds::Aabb;
use glam::DVec3;

use crate::volume::exact::{sign, volume_sign};
use crate::volume::topology::CasterMesh;
use crate::volume::winding::windings;

/// A set of triangles that are connected over shared edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Component {
    /// The box around the component.
    pub bounds: Aabb,
    /// Every edge is run as often one way as the other.
    pub closed: bool,
    /// The enclosed volume if closed, else 0; rounded. Negative where the component is inside
    /// out.
    pub signed_volume: f64,
    /// Bounds `[low, high]` of all winding numbers around the component, if it is closed and
    /// bounds are known. One of them is 0.
    pub winding_range: Option<[i32; 2]>,
}

/// Numbers the components of the mesh and describes them.
pub(crate) fn find(mesh: &mut CasterMesh) {
    number_components(mesh);
    find_closed(mesh);
    let centers = find_bounds(mesh);
    find_volumes(mesh);
    certify(mesh, centers);
    let box_centers: Vec<DVec3> = mesh.components.iter().map(|c| c.bounds.center()).collect();
    certify(mesh, box_centers);
}

fn number_components(mesh: &mut CasterMesh) {
    let mut parents: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    for edge in &mesh.edges {
        let refs = mesh.refs_of(edge);
        for pair in refs.windows(2) {
            let (a, b) = (
                root(&mut parents, pair[0] >> 1),
                root(&mut parents, pair[1] >> 1),
            );
            // The smaller number stays the root, so a root is its component's first triangle.
            parents[a.max(b) as usize] = a.min(b);
        }
    }
    let mut count = 0;
    for t in 0..mesh.triangles.len() {
        let root = root(&mut parents, t as u32) as usize;
        mesh.triangles[t][3] = if root == t {
            count += 1;
            count - 1
        } else {
            mesh.triangles[root][3]
        };
    }
    mesh.components = vec![Component::default(); count as usize];
}

/// The root of a union-find tree, halving the path to it.
fn root(parents: &mut [u32], mut t: u32) -> u32 {
    while parents[t as usize] != t {
        let grandparent = parents[parents[t as usize] as usize];
        parents[t as usize] = grandparent;
        t = grandparent;
    }
    t
}

fn find_closed(mesh: &mut CasterMesh) {
    for component in &mut mesh.components {
        component.closed = true;
    }
    for edge in &mesh.edges {
        let refs = &mesh.refs[edge[2] as usize..][..edge[3] as usize];
        let reversed = refs.iter().filter(|&r| r & 1 == 1).count();
        if reversed * 2 != refs.len() {
            let component = mesh.triangles[(refs[0] >> 1) as usize][3];
            mesh.components[component as usize].closed = false;
        }
    }
}

/// Sets the boxes; gives the mean corner of each component.
fn find_bounds(mesh: &mut CasterMesh) -> Vec<DVec3> {
    let mut sums = vec![(DVec3::ZERO, 0.0); mesh.components.len()];
    for triangle in &mesh.triangles {
        let component = triangle[3] as usize;
        let corners = mesh.corners(triangle);
        let bounds = &mut mesh.components[component].bounds;
        for corner in corners {
            bounds.include(corner);
            sums[component].0 += corner;
        }
        sums[component].1 += 3.0;
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

fn find_volumes(mesh: &mut CasterMesh) {
    for triangle in &mesh.triangles {
        let component = &mesh.components[triangle[3] as usize];
        if component.closed {
            // Relative to the middle, where the terms are smallest.
            let middle = component.bounds.center();
            let [a, b, c] = mesh.corners(triangle).map(|corner| corner - middle);
            mesh.components[triangle[3] as usize].signed_volume += a.dot(b.cross(c)) / 6.0;
        }
    }
}

/// Tries one centre for each closed component that has no range yet.
fn certify(mesh: &mut CasterMesh, centers: Vec<DVec3>) {
    // The side on which all triangles so far have the centre; `None` once two differ.
    let mut sides: Vec<Option<i8>> = mesh
        .components
        .iter()
        .map(|component| (component.closed && component.winding_range.is_none()).then_some(0))
        .collect();
    for triangle in &mesh.triangles {
        let component = triangle[3] as usize;
        let Some(side) = sides[component] else {
            continue;
        };
        let [a, b, c] = mesh.corners(triangle);
        let this = volume_sign(a, b, c, centers[component]);
        sides[component] = (side * this >= 0).then_some(sign(f64::from(side + this)));
    }
    let points: Vec<Option<DVec3>> = sides
        .iter()
        .zip(centers)
        .map(|(side, center)| side.map(|_| center))
        .collect();
    if points.iter().all(Option::is_none) {
        return;
    }
    let windings = windings(mesh, &points);
    for (component, winding) in mesh.components.iter_mut().zip(windings) {
        if let Some(winding) = winding {
            component.winding_range = Some([winding.min(0), winding.max(0)]);
        }
    }
}
