//! Tree files on the disk.

use kdray::file::AnyScene;
use kdray::{BuildOptions, FileError, Ray, Scene, TriangleMesh};
use kdray_file::{Output, TreeFileError, is_tree_file, load, load_any, map, map_any, save};
use std::{fs, path::Path};
use tempfile::TempDir;

type Done = Result<(), Box<dyn std::error::Error>>;

/// A grid of triangles.
fn scene(side: u32) -> Scene {
    let at = |i: u32, j: u32| [i as f32, j as f32, ((i * 7 + j * 3) % 5) as f32];
    let soup = (0..side).flat_map(|i| {
        (0..side).flat_map(move |j| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
    });
    let mesh = TriangleMesh::from_soup(soup).expect("finite corners");
    Scene::build(mesh, &BuildOptions::default()).expect("a small mesh")
}

/// A saved scene in a folder of its own.
fn saved(side: u32) -> (TempDir, Scene) {
    let (folder, scene) = (TempDir::new().expect("a temporary folder"), scene(side));
    save(&scene, &folder.path().join("tree")).expect("the folder can be written to");
    (folder, scene)
}

/// The reason why a file is refused, the same by both ways.
fn refused(path: &Path) -> FileError {
    let reason = |result: Result<Scene, TreeFileError>| match result {
        Err(TreeFileError::File { source, .. }) => source,
        other => panic!("{other:?}"),
    };
    let (loaded, mapped) = (reason(load(path, None)), reason(map(path)));
    assert_eq!(loaded, mapped);
    loaded
}

#[test]
fn both_ways_give_the_same_hits() -> Done {
    let (folder, built) = saved(40);
    let path = folder.path().join("tree");
    assert!(is_tree_file(&path)?);
    let (loaded, mapped): (Scene, Scene) = (load(&path, None)?, map(&path)?);
    assert_eq!(mapped.verify(), Ok(()));
    let mut hits = 0;
    for i in 0..400 {
        let origin = [f64::from(i % 40) + 0.3, f64::from(i / 10) + 0.6, 9.0];
        let ray = Ray::new(origin, [0.01 * f64::from(i % 7), 0.02, -1.0]);
        let hit = built.closest_hit(&ray);
        hits += usize::from(hit.is_some());
        assert_eq!((loaded.closest_hit(&ray), mapped.closest_hit(&ray)), (hit, hit));
    }
    assert!(hits > 300, "{hits}");
    Ok(())
}

#[test]
fn a_new_file_in_its_place_leaves_the_mapped_one() -> Done {
    let (folder, built) = saved(20);
    let path = folder.path().join("tree");
    let mapped: Scene = map(&path)?;
    save(&scene(3), &path)?;
    assert_eq!(mapped.verify(), Ok(()));
    assert_eq!(mapped.mesh(), built.mesh());
    assert_eq!(load::<f32>(&path, None)?.mesh().triangles().len(), 18);
    assert_eq!(fs::read_dir(folder.path())?.count(), 1, "no temporary file is left");
    Ok(())
}

#[test]
fn what_is_no_tree_file_is_refused() -> Done {
    let (folder, _) = saved(3);
    let path = folder.path().join("tree");
    let bytes = fs::read(&path)?;
    let bad = folder.path().join("bad");
    for other in [&b""[..], b"ply\nformat ascii 1.0\n"] {
        fs::write(&bad, other)?;
        assert!(!is_tree_file(&bad)?);
        assert_eq!(refused(&bad), FileError::NotATreeFile);
    }
    for length in [100, 255, 256, 1000, bytes.len() - 1] {
        fs::write(&bad, &bytes[..length])?;
        assert!(is_tree_file(&bad)?);
        assert!(matches!(refused(&bad), FileError::Length { .. }), "{length}");
    }
    let missing = folder.path().join("missing");
    for path in [missing.as_path(), folder.path()] {
        assert!(matches!(load::<f32>(path, None), Err(TreeFileError::Io { .. })));
        assert!(matches!(map::<f32>(path), Err(TreeFileError::Io { .. })));
    }
    for path in [folder.path(), &missing.join("tree")] {
        assert!(matches!(save(&scene(2), path), Err(TreeFileError::Io { .. })));
    }
    Ok(())
}

#[test]
fn damage_is_found_by_loading_and_by_verifying() -> Done {
    let (folder, _) = saved(3);
    let path = folder.path().join("tree");
    let mut bytes = fs::read(&path)?;
    // In a coordinate: the mesh is another, but a valid one.
    bytes[256] ^= 1;
    fs::write(&path, &bytes)?;
    let loaded = load::<f32>(&path, None);
    assert!(matches!(loaded, Err(TreeFileError::File { source: FileError::Damaged, .. })));
    assert_eq!(map::<f32>(&path)?.verify(), Err(FileError::Damaged));
    Ok(())
}

#[test]
fn either_precision_is_read_by_those_who_do_not_know() -> Done {
    let (folder, built) = saved(3);
    let (path, other) = (folder.path().join("tree"), folder.path().join("other"));
    let vertices = built.mesh().vertices().iter().map(|p| p.map(f64::from)).collect();
    let mesh = TriangleMesh::new(vertices, built.mesh().triangles().to_vec())?;
    let in_f64 = Scene::build(mesh, &BuildOptions::default())?;
    save(&in_f64, &other)?;
    assert_eq!(refused(&other), FileError::Precision { found: 64, expected: 32 });
    for any in [load_any(&other, None)?, map_any(&other)?] {
        let AnyScene::F64(scene) = any else { panic!("it is f64") };
        assert_eq!(scene.mesh(), in_f64.mesh());
    }
    for any in [load_any(&path, None)?, map_any(&path)?] {
        let AnyScene::F32(scene) = any else { panic!("it is f32") };
        assert_eq!(scene.mesh(), built.mesh());
    }
    let scene: Scene<f64> = load(&other, None)?;
    assert_eq!(scene.verify(), Ok(()));
    Ok(())
}

#[test]
fn a_file_that_takes_too_much_memory_is_refused() {
    let (folder, _) = saved(3);
    let path = folder.path().join("tree");
    let length = fs::metadata(&path).expect("it is there").len();
    assert!(load::<f32>(&path, Some(3 * length)).is_ok());
    let refused = load::<f32>(&path, Some(3 * length - 1));
    let expected = (3 * length, 3 * length - 1);
    assert!(
        matches!(refused, Err(TreeFileError::Memory { needed, limit, .. }) if (needed, limit) == expected)
    );
}

#[cfg(unix)]
#[test]
fn a_long_file_without_content_takes_no_memory() -> Done {
    // A terabyte of zeros that lies nowhere.
    let folder = TempDir::new()?;
    let path = folder.path().join("sparse");
    let bytes = {
        let (small, _) = saved(3);
        fs::read(small.path().join("tree"))?
    };
    fs::write(&path, &bytes[..256])?;
    fs::File::options().write(true).open(&path)?.set_len(1 << 40)?;
    assert!(matches!(refused(&path), FileError::Length { found, .. } if found == 1 << 40));
    Ok(())
}

#[test]
#[cfg(unix)]
fn links_stay_and_so_do_permissions() -> Done {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let (folder, scene) = saved(3);
    let (file, link) = (folder.path().join("tree"), folder.path().join("link"));
    fs::set_permissions(&file, fs::Permissions::from_mode(0o600))?;
    fs::write(&file, b"older")?;
    symlink(&file, &link)?;
    save(&scene, &link)?;
    assert!(fs::symlink_metadata(&link)?.is_symlink() && is_tree_file(&file)?);
    let (waiting, not_yet) = (folder.path().join("waiting"), folder.path().join("not_yet"));
    symlink("not_yet", &waiting)?;
    save(&scene, &waiting)?;
    assert!(fs::symlink_metadata(&waiting)?.is_symlink() && is_tree_file(&not_yet)?);
    let circle = folder.path().join("circle");
    symlink("circle", &circle)?;
    assert!(save(&scene, &circle).is_err() && fs::symlink_metadata(&circle)?.is_symlink());
    assert_eq!(fs::metadata(&file)?.permissions().mode() & 0o777, 0o600);
    Ok(())
}

#[test]
#[cfg(unix)]
fn what_must_not_be_written_to_is_left_alone() -> Done {
    use std::os::unix::fs::PermissionsExt;
    let (folder, scene) = saved(3);
    let file = folder.path().join("tree");
    fs::write(&file, b"kept")?;
    fs::set_permissions(&file, fs::Permissions::from_mode(0o444))?;
    assert!(matches!(save(&scene, &file), Err(TreeFileError::Io { .. })));
    assert_eq!(fs::read(&file)?, b"kept");
    let (slash, dot) = (folder.path().join("new/"), folder.path().join("new/."));
    for path in [folder.path(), &slash, &dot, Path::new("")] {
        assert!(Output::create(path).is_err(), "{path:?}");
        assert!(matches!(save(&scene, path), Err(TreeFileError::Io { .. })), "{path:?}");
    }
    assert_eq!(fs::read_dir(folder.path())?.count(), 1);
    Ok(())
}

#[test]
#[cfg(target_os = "linux")]
fn a_pipe_without_a_name_is_written_to() -> Done {
    use std::os::fd::AsRawFd;
    let (folder, scene) = saved(3);
    let (mut reader, writer) = std::io::pipe()?;
    let path = Path::new("/dev/fd").join(writer.as_raw_fd().to_string());
    let read = std::thread::spawn(move || {
        let mut bytes = Vec::new();
        std::io::Read::read_to_end(&mut reader, &mut bytes).map(|_| bytes)
    });
    let result = save(&scene, &path);
    drop(writer);
    let bytes = read.join().expect("the reader ends")?;
    result?;
    assert_eq!(bytes, fs::read(folder.path().join("tree"))?);
    Ok(())
}

#[test]
#[cfg(unix)]
fn a_pipe_stays_one() -> Done {
    use std::os::unix::fs::FileTypeExt;
    let (folder, scene) = saved(3);
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status()?;
    assert!(made.success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe)
    });
    save(&scene, &pipe)?;
    let read = reader.join().expect("the reader ends")?;
    assert_eq!(read, fs::read(folder.path().join("tree"))?);
    assert!(fs::metadata(&pipe)?.file_type().is_fifo());
    Ok(())
}
