//! Finding and reading mesh files.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use super::super::model::Shape;
use super::collada::read_collada;

/// Largest mesh file read (bytes): ten times the largest of Baxter's.
const MAX_MESH_BYTES: u64 = 32 * 1024 * 1024;

/// Why a mesh cannot be had.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MeshFault {
    pub message: String,
    /// The path is not allowed, whether or not there is a file.
    pub refused: bool,
}

/// Corner points (m) and triangles, as in the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Triangles {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Reads meshes, each file once.
pub(super) struct MeshStore {
    package_directories: Vec<PathBuf>,
    read: BTreeMap<PathBuf, Triangles>,
}

impl MeshStore {
    pub(super) fn new(package_directories: &[PathBuf]) -> Self {
        Self { package_directories: package_directories.to_vec(), read: BTreeMap::new() }
    }

    /// The mesh called `name` in the robot description `origin`, scaled.
    pub(super) fn load(&mut self, name: &str, scale: [f64; 3], origin: &Path) -> Result<Shape, MeshFault> {
        let path = self.resolve(name, origin)?;
        if !self.read.contains_key(&path) {
            let mesh = read(&path).map_err(|fault| missing(format!("mesh `{name}`: {fault}")))?;
            self.read.insert(path.clone(), mesh);
        }
        let mesh = &self.read[&path];
        let scaled = |v: &[f64; 3]| [v[0] * scale[0], v[1] * scale[1], v[2] * scale[2]];
        let mut triangles = mesh.triangles.clone();
        if scale.iter().product::<f64>() < 0.0 {
            triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
        Ok(Shape::Mesh { vertices: mesh.vertices.iter().map(scaled).collect(), triangles })
    }

    /// The file that `name` stands for, inside its package.
    pub(super) fn resolve(&self, name: &str, origin: &Path) -> Result<PathBuf, MeshFault> {
        let absolute = origin.canonicalize().unwrap_or_default();
        let (root, start, rest) = if let Some(address) = name.strip_prefix("package://") {
            let (package, rest) = address.split_once('/').unwrap_or((address, ""));
            let root = self.package_root(package, &absolute).ok_or_else(|| {
                missing(format!("mesh `{name}`: no directory called `{package}` above the file or among the package directories"))
            })?;
            (root.clone(), root, rest)
        } else if name.contains("://") || Path::new(name).is_absolute() {
            let message = format!("mesh `{name}`: only package:// and paths beside the file are read");
            return Err(MeshFault { message, refused: true });
        } else {
            let directory = absolute.parent().unwrap_or(Path::new("")).to_owned();
            let package = directory.ancestors().find(|above| above.join("package.xml").is_file());
            (package.unwrap_or(&directory).to_owned(), directory, name)
        };
        let outside = || MeshFault { message: format!("mesh `{name}` lies outside {}", root.display()), refused: true };
        let path = joined(&start, rest).ok_or_else(outside)?;
        if !path.starts_with(&root) {
            return Err(outside());
        }
        let found = path.canonicalize().map_err(|_| missing(format!("mesh `{name}` is missing: no {}", path.display())))?;
        let real_root = root.canonicalize().map_err(|_| outside())?;
        if found.starts_with(real_root) { Ok(found) } else { Err(outside()) }
    }

    fn package_root(&self, package: &str, origin: &Path) -> Option<PathBuf> {
        if !matches!(Path::new(package).components().collect::<Vec<_>>()[..], [Component::Normal(_)]) {
            return None;
        }
        let called = |directory: &Path| directory.file_name().is_some_and(|name| name == package);
        let given = self.package_directories.iter().filter_map(|directory| {
            let candidate = if called(directory) { directory.clone() } else { directory.join(package) };
            candidate.is_dir().then_some(candidate)
        });
        let above = origin.ancestors().skip(1).filter(|above| called(above)).map(Path::to_owned);
        given.chain(above).next()
    }
}

fn missing(message: String) -> MeshFault {
    MeshFault { message, refused: false }
}

/// `rest` after `start`, with its `.` and `..` worked out; nothing if it climbs out of the file system.
fn joined(start: &Path, rest: &str) -> Option<PathBuf> {
    let mut path = start.to_owned();
    for part in Path::new(rest).components() {
        match part {
            Component::Normal(name) => path.push(name),
            Component::CurDir => {}
            Component::ParentDir => {
                if !path.pop() {
                    return None;
                }
            }
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(path)
}

fn read(path: &Path) -> Result<Triangles, String> {
    let size = std::fs::metadata(path).map_err(|error| error.to_string())?;
    if !size.is_file() || size.len() > MAX_MESH_BYTES {
        return Err(format!("not a file of at most {MAX_MESH_BYTES} bytes"));
    }
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let mesh = match extension.to_ascii_lowercase().as_str() {
        "dae" => read_collada(std::str::from_utf8(&bytes).map_err(|error| error.to_string())?)?,
        "stl" | "obj" => read_plain(&bytes, &extension.to_ascii_lowercase())?,
        other => return Err(format!("`{other}` is no known mesh format: stl, obj and dae are")),
    };
    let known = u32::try_from(mesh.vertices.len()).map_err(|_| "too many corner points".to_owned())?;
    if mesh.triangles.is_empty() {
        return Err("it holds no triangle".to_owned());
    }
    if mesh.vertices.iter().flatten().any(|part| !part.is_finite()) {
        return Err("a corner point is not finite".to_owned());
    }
    if mesh.triangles.iter().flatten().any(|&corner| corner >= known) {
        return Err("a triangle has a corner that does not exist".to_owned());
    }
    Ok(mesh)
}

/// STL and OBJ, which know neither units nor nodes. Texture and material files that an OBJ names are not read.
fn read_plain(bytes: &[u8], extension: &str) -> Result<Triangles, String> {
    let loader = mesh_loader::Loader::default().custom_reader(|_| Err(std::io::ErrorKind::NotFound.into()));
    let scene = loader.load_from_slice(bytes, format!("mesh.{extension}")).map_err(|error| error.to_string())?;
    let mut all = Triangles::default();
    for mesh in scene.meshes {
        let first = u32::try_from(all.vertices.len()).map_err(|_| "too many corner points".to_owned())?;
        all.vertices.extend(mesh.vertices.iter().map(|vertex| vertex.map(f64::from)));
        all.triangles.extend(mesh.faces.iter().map(|face| face.map(|corner| corner.saturating_add(first))));
    }
    Ok(all)
}
