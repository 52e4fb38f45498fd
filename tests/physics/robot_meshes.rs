//! Contract: meshes arrive in metres, z up, with the transforms of their nodes, whatever the file calls its axes and units.

use std::path::{Path, PathBuf};

use cpdmp::robot::{LoadOptions, Shape, UrdfError, load};

/// A directory of its own for one test, removed at the end.
struct Package(PathBuf);

impl Package {
    fn new(test: &str) -> Self {
        let name = format!("cpdmp-meshes-{test}-{}", std::process::id());
        let package = Self(std::env::temp_dir().join(name).join("arm_description"));
        std::fs::create_dir_all(package.0.join("urdf")).unwrap();
        std::fs::create_dir_all(package.0.join("meshes")).unwrap();
        package
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), content).unwrap();
    }

    /// Loads a robot of one link with the given mesh in its collision shape.
    fn load(&self, mesh: &str) -> Result<Shape, UrdfError> {
        let text = format!(r#"<robot name="r"><link name="a"><collision><geometry><mesh {mesh}/></geometry></collision></link></robot>"#);
        self.write("urdf/arm.urdf", text);
        let mut model = load(&self.0.join("urdf/arm.urdf"), &LoadOptions::default())?.model;
        Ok(model.bodies[0].collisions.remove(0).shape)
    }
}

impl Drop for Package {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(self.0.parent().unwrap_or(Path::new("/nowhere")));
    }
}

fn vertices(shape: &Shape) -> &[[f64; 3]] {
    match shape {
        Shape::Mesh { vertices, .. } => vertices,
        other => panic!("no mesh: {other:?}"),
    }
}

fn holds(shape: &Shape, point: [f64; 3]) -> bool {
    let near = |vertex: &[f64; 3]| vertex.iter().zip(point).all(|(a, b)| (a - b).abs() < 1e-6);
    vertices(shape).iter().any(near)
}

/// One right triangle (0 0 0), (1 0 0), (0 2 0), then what the caller wants around it.
fn collada(asset: &str, nodes: &str) -> String {
    format!(
        r##"<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>{asset}</asset>
        <library_geometries><geometry id="g"><mesh>
          <source id="s"><float_array id="f" count="9">0 0 0 1 0 0 0 2 0</float_array>
            <technique_common><accessor source="#f" count="3" stride="3"/></technique_common></source>
          <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
          <triangles count="1"><input semantic="NORMAL" source="#s" offset="1"/><input semantic="VERTEX" source="#v" offset="0"/>
            <p>0 0 1 0 2 0</p></triangles></mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene id="scene">{nodes}</visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#scene"/></scene></COLLADA>"##
    )
}

const INSTANCE: &str = r##"<instance_geometry url="#g"/>"##;

#[test]
fn collada_units_axes_and_nodes_are_applied() {
    let package = Package::new("collada");
    let file = r#"filename="package://arm_description/meshes/a.dae""#;
    let plain = format!("<node>{INSTANCE}</node>");

    package.write("meshes/a.dae", collada(r#"<unit meter="0.001"/><up_axis>Z_UP</up_axis>"#, &plain));
    assert!(holds(&package.load(file).unwrap(), [0.001, 0.0, 0.0]));
    package.write("meshes/a.dae", collada("<up_axis>Y_UP</up_axis>", &plain));
    assert!(holds(&package.load(file).unwrap(), [0.0, 0.0, 2.0]), "y points up");
    package.write("meshes/a.dae", collada("<up_axis>X_UP</up_axis>", &plain));
    assert!(holds(&package.load(file).unwrap(), [0.0, 0.0, 1.0]), "x points up");

    // Transforms apply last first: the point (1 0 0) is scaled to 2, turned to y, moved to (0 2 5), and moved by its parent to (10 2 5).
    let nested = format!(
        "<node><matrix>1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1</matrix><node><translate>0 0 5</translate><rotate>0 0 1 90</rotate>\
         <scale>2 2 2</scale>{INSTANCE}</node></node><node>{INSTANCE}</node>"
    );
    package.write("meshes/a.dae", collada("<up_axis>Z_UP</up_axis>", &nested));
    let shape = package.load(file).unwrap();
    assert!(holds(&shape, [10.0, 2.0, 5.0]), "{shape:?}");
    assert!(holds(&shape, [1.0, 0.0, 0.0]), "the second instance is not lost");
    assert_eq!(vertices(&shape).len(), 6);
}

#[test]
fn stl_and_obj_are_read_and_scaled() {
    let package = Package::new("plain");
    package.write(
        "meshes/a.stl",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 0\nendloop\nendfacet\nendsolid a\n",
    );
    package.write("meshes/a.obj", "mtllib none.mtl\no one\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\no two\nf 1 2 4\n");
    let stl = package.load(r#"filename="package://arm_description/meshes/a.stl" scale="0.1 0.1 0.1""#).unwrap();
    assert!(holds(&stl, [0.1, 0.0, 0.0]) && holds(&stl, [0.0, 0.2, 0.0]));
    std::fs::write(package.0.join("urdf/b.obj"), std::fs::read(package.0.join("meshes/a.obj")).unwrap()).unwrap();
    let obj = package.load(r#"filename="b.obj""#).unwrap();
    assert!(holds(&obj, [0.0, 0.0, 3.0]), "{obj:?}");
    assert!(matches!(obj, Shape::Mesh { triangles, .. } if triangles.len() == 2));
}

#[test]
fn broken_meshes_are_refused_without_a_panic() {
    let package = Package::new("broken");
    let scene = format!("<node>{INSTANCE}</node>");
    let sound = collada("<up_axis>Z_UP</up_axis>", &scene);
    let cyclic = collada("", r##"<node id="n"><instance_node url="#n"/></node>"##);
    let faults: &[(&str, String, &str)] = &[
        ("a.dae", sound.replace("<p>0 0 1 0 2 0</p>", "<p>0 0 1 0 9 0</p>"), "does not exist"),
        ("a.dae", sound.replace("<p>0 0 1 0 2 0</p>", "<p>0 0</p>"), "no triangle"),
        ("a.dae", sound.replace("1 0 0 0 2 0", "1 0 0 0 x 0"), "no number"),
        ("a.dae", sound.replace("1 0 0 0 2 0", "NaN 0 0 0 2 0"), "not finite"),
        ("a.dae", cyclic, "too deeply"),
        ("a.dae", "<COLLADA/>".to_owned(), "no visual scene"),
        ("a.dae", "no xml".to_owned(), "unknown token"),
        ("a.stl", "solid a\nendsolid a\n".to_owned(), "no triangle"),
        ("a.obj", "v 0 0 0\nf 1 2 3\n".to_owned(), ""),
        ("a.ply", "ply".to_owned(), "no known mesh format"),
    ];
    for (name, content, words) in faults {
        package.write(&format!("meshes/{name}"), content);
        let said = package.load(&format!(r#"filename="package://arm_description/meshes/{name}""#));
        let said = said.map(|_| ()).unwrap_err().to_string();
        assert!(said.contains(words), "{name}: {said}");
    }
}

#[test]
fn paths_that_leave_the_package_are_refused() {
    let package = Package::new("outside");
    let outside = package.0.parent().unwrap().join("secret.stl");
    std::fs::write(&outside, "solid a\nendsolid a\n").unwrap();
    for name in ["package://arm_description/../secret.stl", "../../secret.stl", outside.to_str().unwrap(), "file:///etc/passwd"] {
        let fault = package.load(&format!(r#"filename="{name}""#)).unwrap_err().to_string();
        assert!(fault.contains("outside") || fault.contains("only package://"), "{name}: {fault}");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&outside, package.0.join("meshes/link.stl")).unwrap();
        let fault = package.load(r#"filename="package://arm_description/meshes/link.stl""#).unwrap_err().to_string();
        assert!(fault.contains("outside"), "a symbolic link does not lead out either: {fault}");
    }
}
