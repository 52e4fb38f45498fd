//! Visual and collision shapes of links, with their colours.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Vector3};

use super::super::model::{Body, Geometry, Shape};
use super::build::pose;
use super::finding::{Findings, Place};
use super::mesh::{MeshFault, MeshStore};
use super::outline::LinkEntry;

/// Colour where the file gives none: mid grey.
const GREY: [f32; 4] = [0.6, 0.6, 0.6, 1.0];

/// Gives every visual that only names a material the colour that the file gives this name, at its top or in another visual.
pub(super) fn share_colors(robot: &mut urdf_rs::Robot) {
    let inline = robot.links.iter().flat_map(|link| &link.visual).filter_map(|visual| visual.material.as_ref());
    let mut shared = BTreeMap::new();
    for material in robot.materials.iter().chain(inline) {
        if let Some(color) = &material.color {
            shared.entry(material.name.clone()).or_insert_with(|| color.clone());
        }
    }
    for visual in robot.links.iter_mut().flat_map(|link| &mut link.visual) {
        if let Some(material) = visual.material.as_mut().filter(|material| material.color.is_none()) {
            material.color = shared.get(&material.name).cloned();
        }
    }
}

/// Turns the shapes of links into those of bodies.
pub(super) struct Shapes<'a> {
    meshes: MeshStore,
    findings: &'a mut Findings,
}

impl<'a> Shapes<'a> {
    pub(super) fn new(package_directories: &[PathBuf], findings: &'a mut Findings) -> Self {
        Self { meshes: MeshStore::new(package_directories), findings }
    }

    /// Adds the shapes of `link` to `body`.
    ///
    /// A visual whose mesh is missing is left out with a warning. A collision shape whose mesh is missing is an error, for a robot must not
    /// lose what it collides with, unless another collision shape of the link stands in for it.
    pub(super) fn add(&mut self, link: &urdf_rs::Link, entry: &LinkEntry, body_from_link: &Isometry3<f64>, body: &mut Body) {
        let element = format!("link `{}`", link.name);
        for (visual, place) in link.visual.iter().zip(&entry.visuals) {
            let color = self.color(visual.material.as_ref(), place, &element);
            match self.shapes(&visual.geometry, place) {
                Ok(parts) => {
                    let body_from_visual = body_from_link * pose(&visual.origin);
                    body.visuals.extend(placed(parts, &link.name, &body_from_visual, color));
                }
                Err(fault) if fault.refused => self.findings.error(place, element.as_str(), fault.message, ""),
                Err(fault) => self.findings.warning(place, element.as_str(), fault.message, "it is not shown"),
            }
        }
        let before = body.collisions.len();
        let mut faults = Vec::new();
        for (collision, place) in link.collision.iter().zip(&entry.collisions) {
            match self.shapes(&collision.geometry, place) {
                Ok(parts) => {
                    let body_from_collision = body_from_link * pose(&collision.origin);
                    body.collisions.extend(placed(parts, &link.name, &body_from_collision, GREY));
                }
                Err(fault) => faults.push((fault, place)),
            }
        }
        let has_stand_in = body.collisions.len() > before;
        for (fault, place) in faults {
            if has_stand_in && !fault.refused {
                let help = "the other collision shapes of the link stand in for it";
                self.findings.warning(place, element.as_str(), fault.message, help);
            } else {
                let help = "provide the mesh, or a box, cylinder or sphere beside it";
                self.findings.error(place, element.as_str(), fault.message, help);
            }
        }
    }

    fn color(&mut self, material: Option<&urdf_rs::Material>, place: &Place, element: &str) -> [f32; 4] {
        let Some(material) = material else {
            return GREY;
        };
        match &material.color {
            Some(color) => color.rgba.0.map(|part| part as f32),
            None => {
                if material.texture.is_none() {
                    let message = format!("no colour is given for material `{}`", material.name);
                    self.findings.warning(place, element, message, "it is shown grey");
                }
                GREY
            }
        }
    }

    fn shapes(&mut self, geometry: &urdf_rs::Geometry, place: &Place) -> Result<Parts, MeshFault> {
        let at_origin = |shape| vec![(Isometry3::identity(), shape)];
        Ok(match geometry {
            urdf_rs::Geometry::Box { size } => at_origin(Shape::Box { half_extents: Vector3::from(size.0) * 0.5 }),
            urdf_rs::Geometry::Sphere { radius } => at_origin(Shape::Sphere { radius: *radius }),
            urdf_rs::Geometry::Cylinder { radius, length } => at_origin(cylinder(*radius, *length)),
            urdf_rs::Geometry::Capsule { radius, length } => capsule(*radius, *length),
            urdf_rs::Geometry::Mesh { filename, scale } => {
                let scale = scale.map_or([1.0; 3], |scale| scale.0);
                at_origin(self.meshes.load(filename, scale, Path::new(&place.file))?)
            }
        })
    }
}

/// Shapes with their poses in a common frame.
type Parts = Vec<(Isometry3<f64>, Shape)>;

fn placed<'a>(
    parts: Parts,
    link: &'a str,
    body_from_parts: &'a Isometry3<f64>,
    color_rgba: [f32; 4],
) -> impl Iterator<Item = Geometry> + 'a {
    parts.into_iter().map(move |(parts_from_shape, shape)| Geometry {
        link: link.to_owned(),
        body_from_geometry: body_from_parts * parts_from_shape,
        shape,
        color_rgba,
    })
}

fn cylinder(radius: f64, length: f64) -> Shape {
    Shape::Cylinder { radius, half_length: 0.5 * length }
}

/// A cylinder with a sphere at each end.
fn capsule(radius: f64, length: f64) -> Parts {
    let cap = |z: f64| (Isometry3::translation(0.0, 0.0, z), Shape::Sphere { radius });
    vec![(Isometry3::identity(), cylinder(radius, length)), cap(0.5 * length), cap(-0.5 * length)]
}
