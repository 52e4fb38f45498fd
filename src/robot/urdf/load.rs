//! From the text of a robot description, with its attachments, to a model.

use std::path::{Path, PathBuf};

use nalgebra::Isometry3;
use roxmltree::Document;
use urdf_rs::Robot;

use super::super::model::RobotModel;
use super::build::build;
use super::finding::{Finding, Findings, Place, UrdfError};
use super::mesh::MeshStore;
use super::outline::{JointEntry, Outline};
use super::shapes::share_colors;
use super::structure::{MAX_FILE_BYTES, check};
use super::tree::check_tree;

/// How a robot description is loaded.
#[derive(Debug, Clone, Default)]
pub struct LoadOptions {
    /// Descriptions to mount on links of the robot, e.g. a gripper.
    pub attachments: Vec<Attachment>,
    /// Where `package://NAME/…` is looked for first: directories called NAME, or that hold one. After these, the directory called
    /// NAME above the robot's own file.
    pub package_directories: Vec<PathBuf>,
}

/// A robot description mounted on a link of another by a fixed joint.
#[derive(Debug, Clone)]
pub struct Attachment {
    /// The description (URDF).
    pub text: String,
    /// Its file name, for messages and for the meshes it names.
    pub origin: String,
    /// The link that carries it.
    pub parent_link: String,
    /// Pose of its root link in that link.
    pub parent_from_child: Isometry3<f64>,
}

/// A robot, and what was odd in its description.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The robot.
    pub model: RobotModel,
    /// Findings that do not keep the robot from being used.
    pub warnings: Vec<Finding>,
}

/// Loads the robot description in the file `path`.
///
/// # Errors
/// If the file cannot be read or is no usable robot description, with everything found.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Loaded, UrdfError> {
    let name = path.display().to_string();
    let fault = |message: String| {
        let mut findings = Findings::default();
        findings.error(&Place { file: name.clone(), line: None }, "file", message, "");
        UrdfError { findings: findings.all }
    };
    let size = std::fs::metadata(path).map_err(|error| fault(error.to_string()))?;
    if !size.is_file() || size.len() > MAX_FILE_BYTES as u64 {
        return Err(fault(format!("not a file of at most {MAX_FILE_BYTES} bytes")));
    }
    let bytes = std::fs::read(path).map_err(|error| fault(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|error| fault(error.to_string()))?;
    parse(&text, &name, options)
}

/// The mesh files that decide what the robot in the file `path` can touch, sorted; as far as they can be found.
#[must_use]
pub fn collision_mesh_files(path: &Path, package_directories: &[PathBuf]) -> Vec<PathBuf> {
    let readable = std::fs::metadata(path).is_ok_and(|about| about.is_file() && about.len() <= MAX_FILE_BYTES as u64);
    let text = if readable { std::fs::read_to_string(path).unwrap_or_default() } else { String::new() };
    // Only a text that passes the structural check is sure not to be a bomb.
    if check(&text, &path.display().to_string(), &mut Findings::default()).is_none() {
        return Vec::new();
    }
    let Ok(document) = Document::parse(&text) else { return Vec::new() };
    let meshes = MeshStore::new(package_directories);
    let touched = document.descendants().filter(|node| node.has_tag_name("collision")).flat_map(|node| node.descendants());
    let names = touched.filter(|node| node.has_tag_name("mesh")).filter_map(|mesh| mesh.attribute("filename"));
    let mut files: Vec<PathBuf> = names.filter_map(|name| meshes.resolve(name, path).ok()).collect();
    files.sort();
    files.dedup();
    files
}

/// Reads the robot description `text`. `origin_name` names it in findings; if it is the path of a file, meshes are found from there.
///
/// # Errors
/// If it is no usable robot description, with everything found.
pub fn parse(text: &str, origin_name: &str, options: &LoadOptions) -> Result<Loaded, UrdfError> {
    let mut findings = Findings::default();
    let origin = Place { file: origin_name.to_owned(), line: None };
    let Some((robot, outline)) = read_all(text, &origin, options, &mut findings) else {
        return Err(UrdfError { findings: findings.all });
    };
    let model = build(&robot, &outline, &options.package_directories, &mut findings);
    match model {
        Some(model) if !findings.has_error() => Ok(Loaded { model, warnings: findings.all }),
        _ => Err(UrdfError { findings: findings.all }),
    }
}

/// The robot with its attachments, checked as a whole; nothing when an error was found.
fn read_all(text: &str, origin: &Place, options: &LoadOptions, findings: &mut Findings) -> Option<(Robot, Outline)> {
    let outline = check(text, &origin.file, findings);
    let parts: Vec<Option<Outline>> =
        options.attachments.iter().map(|attachment| check(&attachment.text, &attachment.origin, findings)).collect();
    let mut outline = outline?;
    let roots: Vec<String> = parts.iter().map(|part| part.as_ref().map_or_else(String::new, root_of)).collect();
    for (attachment, (part, root)) in options.attachments.iter().zip(parts.into_iter().zip(&roots)) {
        outline.merge(part?, mount_entry(attachment, root));
    }
    check_tree(&outline, findings, origin);
    if findings.has_error() {
        return None;
    }
    let mut robot = content(text, origin, findings)?;
    for (attachment, root) in options.attachments.iter().zip(&roots) {
        let place = Place { file: attachment.origin.clone(), line: None };
        let part = content(&attachment.text, &place, findings)?;
        robot.joints.push(mount_joint(attachment, root));
        robot.links.extend(part.links);
        robot.joints.extend(part.joints);
    }
    Some((robot, outline))
}

/// What urdf-rs makes of a text that passed the structural check.
fn content(text: &str, place: &Place, findings: &mut Findings) -> Option<Robot> {
    match urdf_rs::read_from_string(text) {
        Ok(mut robot) => {
            share_colors(&mut robot);
            Some(robot)
        }
        Err(fault) => {
            findings.error(place, "robot", fault.to_string(), "");
            None
        }
    }
}

/// Name of the first link that hangs on no joint; empty when there is none.
fn root_of(part: &Outline) -> String {
    let carried: std::collections::BTreeSet<&str> = part.joints.iter().map(|joint| joint.child.as_str()).collect();
    let root = part.links.iter().find(|link| !carried.contains(link.name.as_str()));
    root.map_or_else(String::new, |link| link.name.clone())
}

fn mount_name(attachment: &Attachment, root: &str) -> String {
    format!("{}_to_{root}", attachment.parent_link)
}

fn mount_entry(attachment: &Attachment, root: &str) -> JointEntry {
    JointEntry {
        name: mount_name(attachment, root),
        place: Place { file: attachment.origin.clone(), line: None },
        parent: attachment.parent_link.clone(),
        child: root.to_owned(),
        moves: false,
        mimics: None,
    }
}

fn mount_joint(attachment: &Attachment, root: &str) -> urdf_rs::Joint {
    let (roll, pitch, yaw) = attachment.parent_from_child.rotation.euler_angles();
    urdf_rs::Joint {
        name: mount_name(attachment, root),
        joint_type: urdf_rs::JointType::Fixed,
        origin: urdf_rs::Pose {
            xyz: urdf_rs::Vec3(attachment.parent_from_child.translation.vector.into()),
            rpy: urdf_rs::Vec3([roll, pitch, yaw]),
        },
        parent: urdf_rs::LinkName { link: attachment.parent_link.clone() },
        child: urdf_rs::LinkName { link: root.to_owned() },
        axis: urdf_rs::Axis::default(),
        limit: urdf_rs::JointLimit::default(),
        calibration: None,
        dynamics: None,
        mimic: None,
        safety_controller: None,
    }
}
