//! Circles in a graph: groups of modules each of which reaches every other.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    CrateTree,
    imports::{Edges, Usage},
};

/// Modules that use one another in a circle.
pub struct ModuleCircle {
    /// Paths of the modules.
    pub modules: Vec<String>,
    /// Uses between them: user, used and place.
    pub usages: Vec<(String, String, Usage)>,
}

/// The circles of a crate, the largest first.
pub fn circles(tree: &CrateTree, edges: &Edges) -> Vec<ModuleCircle> {
    let mut used: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &(from, to) in edges.keys() {
        used.entry(from).or_default().push(to);
    }
    let reached: Vec<BTreeSet<usize>> =
        (0..tree.modules.len()).map(|start| reach(&used, start)).collect();
    let mut seen: BTreeSet<usize> = BTreeSet::new();
    let mut found = Vec::new();
    for start in 0..tree.modules.len() {
        if !reached[start].contains(&start) || seen.contains(&start) {
            continue;
        }
        let group: BTreeSet<usize> =
            reached[start].iter().copied().filter(|&to| reached[to].contains(&start)).collect();
        seen.extend(&group);
        found.push(circle(tree, edges, &group));
    }
    found.sort_by_key(|circle| std::cmp::Reverse(circle.modules.len()));
    found
}

/// Everything that can be reached from `start` in one step or more.
fn reach(used: &BTreeMap<usize, Vec<usize>>, start: usize) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut open = vec![start];
    while let Some(at) = open.pop() {
        for &next in used.get(&at).into_iter().flatten() {
            if found.insert(next) {
                open.push(next);
            }
        }
    }
    found
}

fn circle(tree: &CrateTree, edges: &Edges, group: &BTreeSet<usize>) -> ModuleCircle {
    let name = |index: usize| match tree.modules[index].path.as_str() {
        "" => "(root)".to_owned(),
        path => path.to_owned(),
    };
    let inside = edges.iter().filter(|((a, b), _)| group.contains(a) && group.contains(b));
    ModuleCircle {
        modules: group.iter().map(|&index| name(index)).collect(),
        usages: inside.map(|(&(a, b), usage)| (name(a), name(b), usage.clone())).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::{super::Module, *};

    fn tree(names: &[&str]) -> CrateTree {
        let module = |name: &&str| Module {
            path: (*name).to_owned(),
            file: name.into(),
            parent: None,
            children: BTreeMap::new(),
            items: Vec::new(),
        };
        CrateTree { package: "p".into(), modules: names.iter().map(module).collect() }
    }

    #[test]
    fn a_circle_of_two_is_found_and_a_chain_is_not() {
        let usage = Usage { file: "f".into(), line: 1, path: "p".into() };
        let edges: Edges =
            [(0, 1), (1, 2), (2, 1)].into_iter().map(|edge| (edge, usage.clone())).collect();
        let found = circles(&tree(&["a", "b", "c"]), &edges);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].modules, ["b", "c"]);
        assert_eq!(found[0].usages.len(), 2);
    }
}
