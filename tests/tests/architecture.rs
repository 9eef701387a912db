//! The rules of `ARCHITECTURE.md` that can be checked by reading the sources.
//!
//!     cargo test --release -p mist-tests --test architecture
//!
//! A test that fails lists every place at fault.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
};

use mist_tests::sources::{
    CrateTree, circles::circles, files, functions, imports, packages, paths, prose, root, shown,
    trees, type_name,
};

/// Things outside of the process that a crate may be allowed to know.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outside {
    /// The file system.
    Files,
    /// Arguments of the command line; the limits of the service are flags.
    Arguments,
    /// Standard streams, colours and progress bars.
    Terminals,
    /// Network connections and what speaks over them.
    Sockets,
    /// Starting threads or pools of threads; running on the pool of the caller is free.
    Threads,
}

use Outside::{Arguments, Files, Sockets, Terminals, Threads};

/// Dependencies that one crate may have.
struct Rule {
    package: &'static str,
    /// Crates of this workspace that it may depend on.
    uses: &'static [&'static str],
    knows: &'static [Outside],
}

/// Every crate of the workspace. A crate without a row fails `every_crate_has_a_rule`.
const RULES: &[Rule] = &[
    Rule { package: "spectra", uses: &[], knows: &[] },
    Rule { package: "scattering", uses: &[], knows: &[] },
    Rule { package: "mist-format", uses: &[], knows: &[] },
    Rule { package: "mist-engine", uses: &["mist-format", "scattering", "spectra"], knows: &[] },
    Rule { package: "pictures", uses: &["spectra"], knows: &[] },
    Rule {
        package: "preview",
        uses: &["mist-engine", "pictures", "scattering", "spectra"],
        knows: &[],
    },
    Rule {
        package: "rise-bridge",
        uses: &["mist-engine", "mist-format", "pictures", "preview", "scattering", "spectra"],
        knows: &[],
    },
    Rule {
        package: "mist-runner",
        uses: &["mist-engine", "mist-format", "rise-bridge", "scattering"],
        knows: &[Files],
    },
    Rule {
        package: "mist-server",
        uses: &[
            "mist-engine",
            "mist-format",
            "mist-runner",
            "rise-bridge",
            "scattering",
            "spectra",
        ],
        knows: &[Files, Arguments, Sockets, Threads],
    },
    Rule {
        package: "mist-cli",
        uses: &[
            "mist-engine",
            "mist-format",
            "mist-runner",
            "mist-server",
            "pictures",
            "preview",
            "rise-bridge",
            "scattering",
            "spectra",
        ],
        knows: &[Files, Arguments, Terminals, Sockets, Threads],
    },
    Rule { package: "tests", uses: &["mist-engine", "mist-format", "scattering"], knows: &[Files] },
];

impl Outside {
    const ALL: [Self; 5] = [Files, Arguments, Terminals, Sockets, Threads];

    /// Crates that are for this only.
    fn dependencies(self) -> &'static [&'static str] {
        match self {
            Files => &["tempfile", "redb"],
            Arguments => &["clap"],
            Terminals => &["indicatif", "annotate-snippets"],
            Sockets => &["axum", "hyper", "hyper-util", "tokio", "tower-http"],
            Threads => &[],
        }
    }

    /// Paths, or beginnings of paths, that only code that knows it names.
    fn paths(self) -> &'static [&'static str] {
        match self {
            Files => &["std::fs", "fs::", "File::open", "File::create", "OpenOptions"],
            Arguments => &["std::env::args"],
            Terminals => &["std::io::IsTerminal"],
            Sockets => &["std::net", "std::os::unix::net"],
            Threads => &["thread::spawn", "thread::scope", "thread::Builder", "ThreadPoolBuilder"],
        }
    }

    /// True if only code that knows it writes a path such as `std::fs::read`.
    fn is_named_by(self, written: &str) -> bool {
        let written = written.trim_start_matches("rayon::");
        let shortened = written.trim_start_matches("std::");
        self.paths().iter().any(|start| written.starts_with(start) || shortened.starts_with(start))
    }
}

fn all_trees() -> Vec<CrateTree> {
    packages().iter().flat_map(|package| trees(package)).collect()
}

/// Names in the section `[dependencies]` of a package.
fn dependencies(package: &str) -> BTreeSet<String> {
    let path = root().join(package).join("Cargo.toml");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    text.lines()
        .map(str::trim)
        .skip_while(|line| *line != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(|line| line.split(['.', ' ', '=']).next().unwrap_or(line).to_owned())
        .collect()
}

fn assert_none(faults: &[String], rule: &str) {
    assert!(faults.is_empty(), "{rule}:\n{}", faults.join("\n"));
}

/// Fails if there are more than `most` faults.
fn assert_at_most(most: usize, faults: &[String], rule: &str) {
    assert!(
        faults.len() <= most,
        "{rule}: {}, at most {most}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

#[test]
fn every_crate_has_a_rule() {
    let named: Vec<&str> = RULES.iter().map(|rule| rule.package).collect();
    for package in packages() {
        assert!(named.contains(&package.as_str()), "{package} has no row in RULES");
    }
    for name in named {
        assert!(packages().iter().any(|package| package == name), "{name} is not a package");
    }
}

#[test]
fn crates_depend_only_on_the_crates_their_rule_names() {
    let mut faults = Vec::new();
    for rule in RULES {
        for used in dependencies(rule.package) {
            let is_ours = RULES.iter().any(|other| other.package == used);
            if is_ours && !rule.uses.contains(&used.as_str()) {
                faults.push(format!("{} depends on {used}", rule.package));
            }
        }
    }
    assert_none(&faults, "dependencies against RULES");
}

#[test]
fn crates_know_only_what_their_rule_allows() {
    let mut faults = Vec::new();
    for rule in RULES {
        let forbidden: Vec<Outside> =
            Outside::ALL.into_iter().filter(|outside| !rule.knows.contains(outside)).collect();
        let used = dependencies(rule.package);
        for outside in &forbidden {
            for dependency in outside.dependencies().iter().filter(|name| used.contains(**name)) {
                faults.push(format!("{} depends on {dependency} ({outside:?})", rule.package));
            }
        }
        for module in trees(rule.package).iter().flat_map(|tree| &tree.modules) {
            let imported = paths::imported_names(&module.items).into_iter().map(|name| name.path);
            for path in imported.chain(paths::written_paths(&module.items)) {
                let written = path.segments.join("::");
                for outside in forbidden.iter().filter(|outside| outside.is_named_by(&written)) {
                    let file = shown(&module.file);
                    faults.push(format!("{file}:{}: {written} ({outside:?})", path.line));
                }
            }
        }
    }
    assert_none(&faults, "crates know more than RULES allows");
}

#[test]
fn no_modules_use_one_another_in_a_circle() {
    let mut found = Vec::new();
    for tree in all_trees() {
        for circle in circles(&tree, &imports::edges(&tree)) {
            println!("{}: {} modules in a circle", tree.package, circle.modules.len());
            for (user, used, usage) in &circle.usages {
                println!("    {user} -> {used}   {usage}");
            }
            found.extend(circle.modules.iter().map(|module| format!("{}: {module}", tree.package)));
        }
    }
    assert_none(&found, "modules in circles; their uses are above");
}

#[test]
fn no_type_name_stands_twice() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for tree in all_trees() {
        for module in &tree.modules {
            for name in module.items.iter().filter_map(type_name) {
                places.entry(name).or_default().push(shown(&module.file));
            }
        }
    }
    let twice = places.iter().filter(|(_, files)| files.len() > 1);
    let faults: Vec<String> =
        twice.map(|(name, files)| format!("{name}: {}", files.join(", "))).collect();
    assert_none(&faults, "type names that stand twice");
}

#[test]
fn files_are_short() {
    let mut lengths: Vec<(usize, String)> = Vec::new();
    for path in packages().iter().flat_map(|package| files(&root().join(package))) {
        let lines = fs::read_to_string(&path).expect("a source is text").lines().count();
        lengths.push((lines, shown(&path)));
    }
    for (limit, most) in [(500, 0), (400, 5)] {
        let long = lengths.iter().filter(|(lines, _)| *lines > limit);
        let long: Vec<String> = long.map(|(lines, file)| format!("{lines} {file}")).collect();
        assert_at_most(most, &long, &format!("files above {limit} lines"));
    }
}

#[test]
fn every_source_file_says_in_its_first_line_what_it_is() {
    let mut faults = Vec::new();
    for path in packages().iter().flat_map(|package| files(&root().join(package))) {
        let text = fs::read_to_string(&path).expect("a source is text");
        let first = text.lines().next().unwrap_or("");
        if !first.starts_with("//!") && !first.starts_with("#![doc = include_str!(") {
            faults.push(shown(&path));
        }
    }
    assert_none(&faults, "without a first line //!");
}

#[test]
fn doc_comments_begin_with_their_subject() {
    let mut found = Vec::new();
    for path in packages().iter().flat_map(|package| files(&root().join(package))) {
        let text = fs::read_to_string(&path).expect("a source is text");
        for (line, comment) in prose::forbidden_starts(&text) {
            found.push(format!("{}:{line}: {comment}", shown(&path)));
        }
    }
    let rule = format!("doc comments that begin with one of {:?}", prose::FORBIDDEN_STARTS);
    assert_none(&found, &rule);
}

#[test]
fn functions_stay_short() {
    let mut lengths: Vec<usize> =
        all_trees().iter().flat_map(functions::function_lengths).collect();
    lengths.sort_unstable();
    let [median, nine_tenths] = [0.5, 0.9].map(|part| functions::quantile(&lengths, part));
    println!(
        "{} functions: median {median} lines, 90 % {nine_tenths}, 99 % {}, longest {}",
        lengths.len(),
        functions::quantile(&lengths, 0.99),
        lengths.last().copied().unwrap_or(0)
    );
    assert!(median <= 7 && nine_tenths <= 23, "median {median}, 90 % {nine_tenths}");
}
