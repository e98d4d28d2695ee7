//! Does a name mean one type in a room, and do tests lie where the house has them?

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Types that share their name with another of their room, and why.
const SHARED: [(&str, &str, &str); 8] = [
    ("rayproof", "Engine", "the scene on a device has that name in `rayproof-gpu`, so what stands in for it has, too"),
    ("rayproof", "Error", "what stands in for `rayproof-gpu` without devices has its names"),
    ("oracle", "Line", "the second oracle shares nothing with the first but the field's words"),
    ("oracle", "Root", "the second oracle shares nothing with the first but the field's words"),
    ("oracle", "Vector", "the second oracle shares nothing with the first but the field's words"),
    ("files", "Faults", "what a scene's readers say, and what a table's: neither module knows the other"),
    ("gpu", "Results", "what each of two trials of a device writes, in the words of its kernel"),
    ("cpu", "Candidate", "twins of two files that no kernel is linked of both"),
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("the folder is read").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// The sources of the rooms, and those of the tests.
fn all_sources() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    let mut found = Vec::new();
    sources(&root.join("crates"), &mut found);
    sources(&root.join("tests/src"), &mut found);
    assert!(found.len() > 200, "only {} sources", found.len());
    found
}

/// The room that a source is of.
fn room(path: &Path) -> Option<&str> {
    let mut parts = path.iter().map(|part| part.to_str().expect("paths are text"));
    parts.by_ref().find(|part| *part == "crates")?;
    parts.next()
}

/// The type that a line declares outside of any other item.
fn declared(line: &str) -> Option<&str> {
    let words = line.strip_prefix("pub").map_or(line, |rest| rest.split_once(' ').map_or("", |(_, item)| item));
    let (kind, rest) = words.split_once(' ')?;
    let name = rest.split(|c: char| !c.is_alphanumeric()).next()?;
    ["struct", "enum", "trait", "union", "type"].contains(&kind).then_some(name)
}

#[test]
fn a_name_means_one_type_in_a_room() {
    let mut types: BTreeMap<(String, String), Vec<PathBuf>> = BTreeMap::new();
    for path in all_sources() {
        let is_test = path.iter().any(|part| part == "tests") || path.ends_with("tests.rs");
        let Some(room) = room(&path).filter(|_| !is_test && path.iter().any(|part| part == "src")) else { continue };
        let text = fs::read_to_string(&path).expect("a source is text");
        for name in text.lines().filter_map(declared) {
            types.entry((room.to_owned(), name.to_owned())).or_default().push(path.clone());
        }
    }
    println!("{} types", types.len());
    assert!(types.len() > 200);
    for ((room, name), at) in types.iter().filter(|(_, at)| at.len() > 1) {
        let known = SHARED.iter().any(|(of, shared, _)| of == room && shared == name);
        assert!(known, "{name} is {} types of {room}: {at:?}", at.len());
    }
}

#[test]
fn tests_lie_in_their_file_or_in_a_module_of_it() {
    // In two parts, so that this line is not found.
    let elsewhere = ["#[pa", "th ="].concat();
    for path in all_sources() {
        let name = path.file_name().and_then(|name| name.to_str()).expect("paths are text");
        assert!(!name.ends_with("_tests.rs") && !name.ends_with("_test.rs"), "{}", path.display());
        let text = fs::read_to_string(&path).expect("a source is text");
        assert!(!text.contains(&elsewhere), "{} takes a module from elsewhere", path.display());
    }
}
