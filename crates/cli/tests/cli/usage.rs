//! What is typed wrong is said, with exit code 2, before anything is done; what can be typed is explained.

use super::Folder;

#[test]
fn version_and_help_go_to_stdout() {
    let folder = Folder::new();
    let version = folder.run("--version").expect(0, &[]);
    assert_eq!(version.stdout, format!("rayproof {}\n", env!("CARGO_PKG_VERSION")).into_bytes());
    for command in ["", "intersect", "rays", "render", "devices"] {
        let help = String::from_utf8(folder.run(&format!("{command} --help")).expect(0, &[]).stdout).unwrap();
        assert!(help.contains("Usage:") && help.contains("rayproof "), "{help}");
        assert!(help.contains("xample") || command.is_empty(), "{command}: an example is missing\n{help}");
    }
}

#[test]
fn a_wrong_command_line_is_exit_code_2_and_touches_nothing() {
    let folder = Folder::with_scene();
    let before = folder.names();
    let cases = [
        ("", "Usage"),
        ("shoot", "shoot"),
        ("intersect scene.toml rays.csv", "--output <HITS>"),
        ("intersect scene.toml -o hits.npy", "<RAYS>"),
        ("intersect scene.toml rays.csv -o hits.npy --fast", "--fast"),
        (
            "intersect scene.toml rays.csv -o hits.npy --precision quadruple",
            "textbook, classic, fast, pair, double, exact",
        ),
        ("intersect scene.toml rays.csv -o hits.npy --query all", "closest, any, count"),
        ("intersect scene.toml rays.csv -o hits.npy --query count --precision fast", "--precision exact"),
        ("intersect scene.toml rays.csv -o hits.npy --device cuda:0", "index:N"),
        ("intersect scene.toml rays.csv -o hits.npy --check -1", "-1"),
        ("intersect scene.toml rays.csv -o hits.npy --check many", "many"),
        ("intersect scene.toml rays.csv -o hits.npy --shard 4/4", "I/N"),
        ("intersect scene.toml rays.csv -o hits.npy --invalid skip", "error, miss"),
        ("intersect scene.toml rays.csv -o hits.txt", ".npy"),
        ("intersect scene.toml rays.csv -o hits", ".npy"),
        ("intersect scene.toml rays.csv -o - --json", "--json"),
        ("rays scene.toml -o rays.xyz", ".npy"),
        ("rays scene.toml -o new.npy --size 10", "WxH"),
        ("rays scene.toml -o new.npy --size 0x10", "WxH"),
        ("rays scene.toml -o new.npy --kind diffuse --size 8x8 --count 9", "--count"),
        ("rays scene.toml -o new.npy --kind primary --count 9", "--size"),
        ("rays scene.toml -o new.npy --kind random", "incoherent"),
        ("render scene.toml -o picture.jpg", ".png"),
        ("render scene.toml -o picture.png --show temperature", "normal, depth"),
        ("render scene.toml -o picture.png --size 800x600x3", "WxH"),
    ];
    for (line, part) in cases {
        let ran = folder.run(line).expect(2, &[part]);
        assert!(ran.stdout.is_empty(), "{line}");
    }
    assert_eq!(folder.names(), before);
}

#[test]
fn a_device_that_is_not_there_is_exit_code_4_and_the_others_are_listed() {
    let folder = Folder::with_scene();
    for device in ["name:no-such-adapter", "index:99", "pci:ffff:ff:1f.7"] {
        for line in ["intersect scene.toml rays.csv -o hits.npy", "render scene.toml -o picture.png"] {
            folder.run(&format!("{line} --device {device}")).expect(4, &["cpu"]);
        }
    }
    assert!(!folder.path("hits.npy").exists() && !folder.path("picture.png").exists());
}

#[test]
fn the_endings_offered_are_those_of_this_build_and_a_missing_folder_is_named() {
    let folder = Folder::with_scene();
    for line in ["intersect scene.toml rays.csv", "rays scene.toml"] {
        let ran = folder.run(&format!("{line} -o x.txt")).expect(2, &["x.txt", "give a name that ends in .npy"]);
        assert_eq!(ran.stderr.contains("parquet"), cfg!(feature = "parquet"), "{}", ran.stderr);
        let ran = folder.run(&format!("{line} -o absent/x.npy"));
        ran.expect(1, &["absent/x.npy: the folder absent does not exist"]);
    }
    folder.run("render scene.toml -o absent/x.png").expect(1, &["absent/x.png: the folder absent does not exist"]);
}

#[cfg(unix)]
#[test]
fn without_a_login_session_nothing_is_said_of_it() {
    let folder = Folder::new();
    let output = folder.command("devices").env_remove("XDG_RUNTIME_DIR").output().unwrap();
    let ran = super::Ran::of("devices", output).expect(0, &[]);
    assert_eq!(ran.stderr, "");
}

#[test]
fn devices_are_listed_with_their_arithmetic() {
    let folder = Folder::new();
    let text = String::from_utf8(folder.run("devices").expect(0, &[]).stdout).unwrap();
    let json = folder.run("devices --json").expect(0, &[]).json();
    let adapters = json["adapters"].as_array().unwrap();
    assert!(!adapters.is_empty(), "no Vulkan adapter: the tests need one, if only llvmpipe");
    assert!(text.contains("cpu ") && json["cpu"]["name"].as_str().unwrap().starts_with("CPU engine"));
    for (i, adapter) in adapters.iter().enumerate() {
        assert_eq!(adapter["index"], i);
        assert!(text.contains(&format!("index:{i} ")) && text.contains(adapter["name"].as_str().unwrap()), "{text}");
        let used = &adapter["fingerprints"][0];
        assert!(used["pairs"].as_u64().unwrap() > 1000 && used["ieee"].is_boolean(), "{adapter}");
    }
}

#[test]
fn the_summary_names_the_adapter_that_ran() {
    let folder = Folder::with_scene();
    let listing = folder.run("devices --json").expect(0, &[]).json();
    let name = listing["adapters"][0]["name"].as_str().unwrap();
    let ran = folder.run("intersect scene.toml rays.csv -o hits.csv --device index:0 --json --check 5");
    assert_eq!(ran.expect(0, &[name]).json()["device"], name);
    assert_eq!(super::csv_hits(&folder.read("hits.csv")), super::HITS);
    let ran = folder.run("intersect scene.toml rays.csv -o hits.csv --json").expect(0, &[]);
    assert_eq!(ran.json()["device"], listing["auto"], "auto is what `devices` says");
}
