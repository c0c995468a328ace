//! The tree of a text goes in; warnings come out about what is written there and the model does not keep:
//! flags, names that stand nowhere else, actions word for word, and the facts one by one.
//!
//! All of it looks at words and parentheses, so that it holds for every dialect.

use hashbrown::HashMap;

use super::{action, initial, list, requirement};
use crate::diagnostic::{Diagnostics, unused_function, unused_type};
use crate::model::{Domain, TypeId};
use crate::tree::{NodeId, Tree};

/// A section, or another list that starts with a word.
#[derive(Clone, Copy)]
pub(super) struct Section {
    pub(super) list: NodeId,
    pub(super) keyword: NodeId,
}

/// A text of a domain or a problem.
pub(super) struct Text<'t, 'a> {
    pub(super) tree: &'t Tree<'a>,
    pub(super) sections: Vec<Section>,
}

impl<'t, 'a> Text<'t, 'a> {
    pub(super) fn new(tree: &'t Tree<'a>) -> Self {
        let mut text = Self { tree, sections: Vec::new() };
        if let Some(root) = tree.roots().next() {
            text.sections = tree.children(root).filter_map(|child| text.section(child)).collect();
        }
        text
    }

    /// A list with the word that it starts with.
    fn section(&self, list: NodeId) -> Option<Section> {
        let keyword = self.tree.children(list).next()?;
        let found = self.tree.is_list(list) && !self.tree.is_list(keyword);
        found.then_some(Section { list, keyword })
    }

    /// Whether the node is this word.
    pub(super) fn is(&self, node: NodeId, word: &str) -> bool {
        self.tree.slice(node).eq_ignore_ascii_case(word)
    }

    /// The sections of this kind.
    pub(super) fn all(&self, keyword: &str) -> impl Iterator<Item = Section> {
        self.sections.iter().copied().filter(move |section| self.is(section.keyword, keyword))
    }

    /// All words in a list.
    fn words(&self, list: NodeId) -> impl Iterator<Item = &'a str> {
        let (first, next) = (list.0 + 1, self.tree.node(list).next);
        (first..next)
            .map(NodeId)
            .filter(|&id| self.tree.node(id).kind == crate::tree::NodeKind::Atom)
            .map(|id| self.tree.slice(id))
    }
}

/// What there is to say about a text.
pub(super) fn check(text: &Text<'_, '_>, domain: &Domain, found: &mut Diagnostics) {
    list::check(text, found);
    let is_problem = text.sections.iter().any(|section| text.is(section.keyword, "problem"));
    if is_problem {
        initial::check(text, domain, found);
        return;
    }
    let words = count(text);
    requirement::check(text, &words, found);
    // A domain without anything that happens is a vocabulary, and using it is left to others.
    if ["action", "durative-action", "process", "event", "task"]
        .iter()
        .any(|kind| words.counts(&format!(":{kind}")) > 0)
    {
        // The domains of all agents declare the same, and each uses its part.
        let mut flags = text.all(":requirements").flat_map(|section| text.words(section.list));
        if !flags.any(|flag| flag.eq_ignore_ascii_case(":factored-privacy")) {
            functions(domain, &words, found);
            types(domain, &words, found);
        }
        action::check(text, &words, found);
    }
}

/// How often each word stands in a domain, in lower case. Flags, the hierarchy of types and the declarations of functions are apart.
pub(super) struct Words {
    here: HashMap<String, u32>,
    functions: HashMap<String, u32>,
}

impl Words {
    /// How often the word stands outside `:requirements`, `:types` and `:functions`.
    pub(super) fn counts(&self, word: &str) -> u32 {
        self.here.get(&word.to_ascii_lowercase()).copied().unwrap_or(0)
    }

    /// Whether one of all words is like this.
    pub(super) fn any(&self, like: impl Fn(&str) -> bool) -> bool {
        self.here.keys().chain(self.functions.keys()).any(|word| like(word))
    }
}

fn count(text: &Text<'_, '_>) -> Words {
    let mut words = Words { here: HashMap::new(), functions: HashMap::new() };
    for &section in &text.sections {
        let table = if text.is(section.keyword, ":functions") {
            &mut words.functions
        } else if [":requirements", ":types"].iter().any(|apart| text.is(section.keyword, apart)) {
            *words
                .here
                .entry_ref(&text.tree.slice(section.keyword).to_ascii_lowercase())
                .or_insert(0) += 1;
            continue;
        } else {
            &mut words.here
        };
        for word in text.words(section.list) {
            // `-truck` stands for `- truck`.
            let bare = word.strip_prefix('-').filter(|bare| !bare.is_empty()).unwrap_or(word);
            *table.entry_ref(&bare.to_ascii_lowercase()).or_insert(0) += 1;
        }
    }
    words
}

/// Reports functions that nothing names. One without parameters may stand in the metric of a problem.
fn functions(domain: &Domain, words: &Words, found: &mut Diagnostics) {
    for function in &domain.functions {
        let name = &function.name;
        if !function.parameters.is_empty() && words.counts(&name.text) == 0 {
            found.push(unused_function::unused_function(&name.text, name.span));
        }
    }
}

/// Reports types that nothing names, nor any type above or below them.
fn types(domain: &Domain, words: &Words, found: &mut Diagnostics) {
    let named = |id: TypeId| {
        let word = domain.types[id.index()].name.text.to_ascii_lowercase();
        words.here.contains_key(&word) || words.functions.contains_key(&word)
    };
    // Where anything may stand, every type takes part.
    let root = TypeId(0);
    let parameters = domain.predicates.iter().flat_map(|predicate| &predicate.parameters);
    let parameters = parameters.chain(domain.signatures.iter().flat_map(|one| &one.parameters));
    if parameters.into_iter().any(|parameter| parameter.types.contains(&root)) {
        return;
    }
    let mut used: Vec<bool> = (0..domain.types.len() as u32).map(|id| named(TypeId(id))).collect();
    // What stands above a type that is used, and below one, is used by way of it.
    let above: Vec<TypeId> = (1..domain.types.len())
        .filter(|&id| used[id])
        .flat_map(|id| domain.types[id].ancestors.iter().copied())
        .collect();
    let below: Vec<usize> = (1..domain.types.len())
        .filter(|&id| {
            domain.types[id].ancestors.iter().any(|&above| above != root && used[above.index()])
        })
        .collect();
    above.into_iter().map(TypeId::index).chain(below).for_each(|id| used[id] = true);
    for (of, used) in domain.types.iter().zip(used).skip(1) {
        if !used {
            found.push(unused_type::unused_type(&of.name.text, of.name.span));
        }
    }
}
