//! Reading the triangles of a COLLADA (.dae) file: every instance of every geometry in the scene, with node transforms, unit and up axis.
//!
//! mesh-loader 0.1.13 is not used for it: it ignores the up axis, keeps one instance of a geometry, and panics on indices out of range.
//! Lines, splines, skins and cameras are left out; polygons are cut into fans. COLLADA 1.4, chapters 3 (unit, up axis) and 5 (geometry).

use std::collections::BTreeMap;

use nalgebra::{Matrix4, Point3, Rotation3, Unit, Vector3};
use roxmltree::{Document, Node};

use super::elements::elements;
use super::mesh::Triangles;
use super::outline::child;

/// Deepest nesting of nodes, instances included, so that a scene that contains itself ends.
const MAX_DEPTH: usize = 32;
/// Most triangles of a scene, so that instances of instances end too.
const MAX_TRIANGLES: usize = 4_000_000;

/// Corner points in metres, z up.
pub(super) fn read_collada(text: &str) -> Result<Triangles, String> {
    let document = Document::parse(text).map_err(|fault| fault.to_string())?;
    let root = document.root_element();
    let by_id = root.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
    let mut scene = Scene { by_id, triangles: Triangles::default() };
    let asset = child(root, "asset");
    let visual = child(root, "scene")
        .and_then(|node| child(node, "instance_visual_scene"))
        .and_then(|instance| scene.target(instance))
        .ok_or("it has no visual scene")?;
    scene.nodes(visual, &frame_of(asset)?, 0)?;
    Ok(scene.triangles)
}

/// From file axes and units to metres with z up.
fn frame_of(asset: Option<Node<'_, '_>>) -> Result<Matrix4<f64>, String> {
    let text_of = |name| asset.and_then(|asset| child(asset, name));
    let unit = match text_of("unit").and_then(|unit| unit.attribute("meter")) {
        Some(text) => text.trim().parse::<f64>().map_err(|_| format!("unit \"{text}\" is no number"))?,
        None => 1.0,
    };
    let half_turn = std::f64::consts::FRAC_PI_2;
    let turn = match text_of("up_axis").and_then(|up| up.text()).map(str::trim) {
        Some("Z_UP") => Rotation3::identity(),
        Some("X_UP") => Rotation3::from_axis_angle(&Vector3::y_axis(), -half_turn),
        Some("Y_UP") | None => Rotation3::from_axis_angle(&Vector3::x_axis(), half_turn),
        Some(other) => return Err(format!("up axis `{other}` is not known")),
    };
    Ok(turn.to_homogeneous() * Matrix4::new_scaling(unit))
}

struct Scene<'a, 'input> {
    by_id: BTreeMap<&'a str, Node<'a, 'input>>,
    triangles: Triangles,
}

impl<'a, 'input> Scene<'a, 'input> {
    /// The element that an instance's url or an input's source names.
    fn target(&self, instance: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
        let address = instance.attribute("url").or_else(|| instance.attribute("source"))?;
        self.by_id.get(address.strip_prefix('#')?).copied()
    }

    /// All geometry below `parent`, whose frame is `pose` in the scene.
    fn nodes(&mut self, parent: Node<'a, 'input>, pose: &Matrix4<f64>, depth: usize) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err("nodes are nested too deeply".to_owned());
        }
        let mut pose = *pose;
        for node in elements(parent) {
            match node.tag_name().name() {
                "node" => self.nodes(node, &pose, depth + 1)?,
                "instance_node" => {
                    let target = self.target(node).ok_or("an instance names no node")?;
                    self.nodes(target, &pose, depth + 1)?;
                }
                "instance_geometry" => {
                    let target = self.target(node).ok_or("an instance names no geometry")?;
                    self.geometry(target, &pose)?;
                }
                _ => pose *= transform(node)?,
            }
        }
        Ok(())
    }

    fn geometry(&mut self, geometry: Node<'a, 'input>, pose: &Matrix4<f64>) -> Result<(), String> {
        let Some(mesh) = child(geometry, "mesh") else {
            return Ok(());
        };
        for primitive in elements(mesh) {
            let polygons = match primitive.tag_name().name() {
                "triangles" => corners(primitive, |count| vec![3; count / 3])?,
                "polylist" => {
                    let counts = child(primitive, "vcount").ok_or("a polylist has no vcount")?;
                    let counts: Vec<usize> = numbers(counts)?;
                    corners(primitive, |_| counts.clone())?
                }
                "polygons" => corners(primitive, |count| vec![count])?,
                _ => continue,
            };
            let points = self.positions(primitive)?;
            self.fans(&points, &polygons, pose)?;
        }
        Ok(())
    }

    /// The positions that a primitive's VERTEX input leads to.
    fn positions(&self, primitive: Node<'a, 'input>) -> Result<Vec<Point3<f64>>, String> {
        let source = vertex_input(primitive)
            .and_then(|input| self.target(input))
            .and_then(|vertices| elements(vertices).find(|node| node.attribute("semantic") == Some("POSITION")))
            .and_then(|input| self.target(input))
            .ok_or("a primitive has no positions")?;
        let values: Vec<f64> = numbers(child(source, "float_array").ok_or("positions have no float_array")?)?;
        let stride = elements(source).flat_map(elements).find_map(|node| node.attribute("stride"));
        let stride = stride.map_or(Ok(3), str::parse).map_err(|_| "a stride is no number")?;
        if stride < 3 {
            return Err("positions have fewer than three parts".to_owned());
        }
        Ok(values.chunks_exact(stride).map(|point| Point3::new(point[0], point[1], point[2])).collect())
    }

    /// Adds polygons as fans of triangles.
    fn fans(&mut self, points: &[Point3<f64>], polygons: &[Vec<usize>], pose: &Matrix4<f64>) -> Result<(), String> {
        let first = self.triangles.vertices.len();
        let turned = pose.fixed_view::<3, 3>(0, 0).determinant() < 0.0;
        let placed = points.iter().map(|point| <[f64; 3]>::from(pose.transform_point(point).coords));
        self.triangles.vertices.extend(placed);
        for polygon in polygons {
            if polygon.iter().any(|&corner| corner >= points.len()) {
                return Err("a polygon has a corner that does not exist".to_owned());
            }
            let index = |corner: usize| u32::try_from(first + polygon[corner]).map_err(|_| "too many corner points");
            for k in 2..polygon.len() {
                let (b, c) = if turned { (k, k - 1) } else { (k - 1, k) };
                self.triangles.triangles.push([index(0)?, index(b)?, index(c)?]);
            }
        }
        if self.triangles.triangles.len() > MAX_TRIANGLES {
            return Err(format!("more than {MAX_TRIANGLES} triangles"));
        }
        Ok(())
    }
}

fn vertex_input<'a, 'input>(primitive: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
    elements(primitive).find(|node| node.attribute("semantic") == Some("VERTEX"))
}

/// Position indices of each polygon; `sizes` tells from the number of corners in one `<p>` how they divide into polygons.
fn corners(primitive: Node<'_, '_>, sizes: impl Fn(usize) -> Vec<usize>) -> Result<Vec<Vec<usize>>, String> {
    let offset_of = |input: Node<'_, '_>| input.attribute("offset").and_then(|offset| offset.parse::<usize>().ok());
    let inputs = elements(primitive).filter(|node| node.has_tag_name("input"));
    let stride = 1 + inputs.filter_map(offset_of).max().unwrap_or(0);
    let offset = vertex_input(primitive).and_then(offset_of).unwrap_or(0);
    let mut polygons = Vec::new();
    for list in elements(primitive).filter(|node| node.has_tag_name("p")) {
        let indices: Vec<usize> = numbers(list)?;
        let mut vertices = indices.chunks_exact(stride).map(|corner| corner[offset]);
        for size in sizes(indices.len() / stride) {
            polygons.push(vertices.by_ref().take(size).collect());
        }
    }
    Ok(polygons)
}

/// The transform that an element of a node stands for; the identity for elements that are none.
fn transform(node: Node<'_, '_>) -> Result<Matrix4<f64>, String> {
    let kind = node.tag_name().name();
    let count = match kind {
        "matrix" => 16,
        "rotate" => 4,
        "translate" | "scale" => 3,
        "lookat" | "skew" => return Err(format!("transform `{kind}` is not read")),
        _ => return Ok(Matrix4::identity()),
    };
    let parts: Vec<f64> = numbers(node)?;
    if parts.len() != count {
        return Err(format!("transform `{kind}` needs {count} numbers, not {}", parts.len()));
    }
    Ok(match kind {
        "matrix" => Matrix4::from_row_slice(&parts),
        "rotate" => match Unit::try_new(Vector3::new(parts[0], parts[1], parts[2]), 0.0) {
            Some(axis) => Rotation3::from_axis_angle(&axis, parts[3].to_radians()).to_homogeneous(),
            None => Matrix4::identity(),
        },
        "translate" => Matrix4::new_translation(&Vector3::new(parts[0], parts[1], parts[2])),
        _ => Matrix4::new_nonuniform_scaling(&Vector3::new(parts[0], parts[1], parts[2])),
    })
}

fn numbers<T: std::str::FromStr>(node: Node<'_, '_>) -> Result<Vec<T>, String> {
    let text = node.text().unwrap_or_default();
    let read = |token: &str| token.parse().map_err(|_| format!("\"{token}\" is no number"));
    text.split_ascii_whitespace().map(read).collect()
}
