//! The texts of a run go in; models come out, with all that is wrong with the texts.

use logos::Logos;

use crate::annotation::{self, Models};
use crate::ast;
use crate::check;
use crate::diagnostic::{Diagnostics, unsupported_feature};
use crate::execute;
use crate::lexer::TokenKind;
use crate::model;
use crate::source::{SourceId, Sources};
use crate::symbol::Occurrences;
use crate::syntax;
use crate::tree;

/// Reads a domain. There is always a model: it contains what could be understood.
pub fn read_domain(sources: &Sources, id: SourceId) -> (model::Domain, Diagnostics) {
    domain(sources, id, None)
}

/// Reads a domain and lists all names in it with what they mean.
pub fn index_domain(sources: &Sources, id: SourceId) -> (model::Domain, Diagnostics, Occurrences) {
    let mut occurrences = Occurrences::default();
    let (domain, diagnostics) = domain(sources, id, Some(&mut occurrences));
    occurrences.sort();
    (domain, diagnostics, occurrences)
}

fn domain(
    sources: &Sources,
    id: SourceId,
    occurrences: Option<&mut Occurrences>,
) -> (model::Domain, Diagnostics) {
    let mut diagnostics = Diagnostics::default();
    let tree = tree::parse(id, &sources.get(id).text, &mut diagnostics);
    let ast = syntax::domain(&tree, &mut diagnostics);
    let domain = check::domain(&ast, &mut diagnostics, occurrences);
    if !diagnostics.has_errors()
        && domain.uses.is_empty()
        && let Err(unstratified) = execute::stratified(&domain)
    {
        diagnostics.push(unstratified.diagnostic(&domain));
    }
    let models = Models { domain: Some(&domain), problem: None };
    diagnostics.append(annotation::read(&tree, models).1);
    (domain, sorted(diagnostics))
}

/// Reads a problem of `domain`. There is always a model: it contains what could be understood.
pub fn read_problem(
    sources: &Sources,
    id: SourceId,
    domain: &model::Domain,
) -> (model::Problem, Diagnostics) {
    problem(sources, id, domain, None)
}

/// Reads a problem of `domain` and lists all names in it with what they mean.
pub fn index_problem(
    sources: &Sources,
    id: SourceId,
    domain: &model::Domain,
) -> (model::Problem, Diagnostics, Occurrences) {
    let mut occurrences = Occurrences::default();
    let (problem, diagnostics) = problem(sources, id, domain, Some(&mut occurrences));
    occurrences.sort();
    (problem, diagnostics, occurrences)
}

fn problem(
    sources: &Sources,
    id: SourceId,
    domain: &model::Domain,
    occurrences: Option<&mut Occurrences>,
) -> (model::Problem, Diagnostics) {
    let mut diagnostics = Diagnostics::default();
    let tree = tree::parse(id, &sources.get(id).text, &mut diagnostics);
    let ast = syntax::problem(&tree, &mut diagnostics);
    let problem = check::problem(&ast, domain, &mut diagnostics, occurrences);
    if diagnostics.list.iter().any(|diagnostic| diagnostic.name == "domain-name-mismatch") {
        without_strangers(&mut diagnostics);
    }
    let models = Models { domain: Some(domain), problem: Some(&problem) };
    diagnostics.append(annotation::read(&tree, models).1);
    (problem, sorted(diagnostics))
}

/// One error for each part of the language that is used and cannot be planned or validated.
///
/// `uses` are those of a domain and its problem. Such files are right: what is refused is to run them.
pub fn refusals<'u>(uses: impl IntoIterator<Item = &'u model::Use>) -> Diagnostics {
    let refuse = |used: &model::Use| {
        unsupported_feature::unsupported_feature(used.feature.describe(), used.span)
    };
    Diagnostics { list: uses.into_iter().map(refuse).collect() }
}

/// Against the wrong domain nearly every name is unknown. That is one mistake, and it is said once: what else is said of names and types goes.
fn without_strangers(diagnostics: &mut Diagnostics) {
    if diagnostics.list.iter().any(|diagnostic| diagnostic.name == "unknown-predicate") {
        let of_names = |code: &str| code.starts_with("E01") || code.starts_with("E02");
        diagnostics.list.retain(|diagnostic| {
            diagnostic.name == "domain-name-mismatch" || !of_names(diagnostic.code)
        });
    }
}

/// Reads a domain without resolving names.
pub fn parse_domain<'a>(
    sources: &'a Sources,
    id: SourceId,
    diagnostics: &mut Diagnostics,
) -> ast::Domain<'a> {
    let tree = tree::parse(id, &sources.get(id).text, diagnostics);
    syntax::domain(&tree, diagnostics)
}

/// Reads a problem without resolving names.
pub fn parse_problem<'a>(
    sources: &'a Sources,
    id: SourceId,
    diagnostics: &mut Diagnostics,
) -> ast::Problem<'a> {
    let tree = tree::parse(id, &sources.get(id).text, diagnostics);
    syntax::problem(&tree, diagnostics)
}

/// Mistakes in the order of the text, whichever step found them.
fn sorted(mut diagnostics: Diagnostics) -> Diagnostics {
    diagnostics.list.sort_by_key(|diagnostic| diagnostic.primary.span.start);
    diagnostics
}

/// What a text defines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Kind {
    /// `(define (domain NAME) …)`
    Domain {
        /// Its name.
        name: String,
    },
    /// `(define (problem NAME) (:domain DOMAIN) …)`
    Problem {
        /// Its name.
        name: String,
        /// The domain that it names.
        domain: Option<String>,
    },
}

/// Looks at the beginning of a text and says what it defines, if it defines anything.
pub fn detect(sources: &Sources, id: SourceId) -> Option<Kind> {
    let text = &sources.get(id).text;
    let mut words = TokenKind::lexer(text)
        .spanned()
        .filter(|(kind, _)| {
            matches!(kind, Ok(TokenKind::Open | TokenKind::Close | TokenKind::Atom))
        })
        .map(|(_, range)| &text[range]);
    let mut word = || words.next();
    let opening = [word()?, word()?, word()?, word()?];
    let defines =
        opening[0] == "(" && opening[1].eq_ignore_ascii_case("define") && opening[2] == "(";
    if !defines {
        return None;
    }
    let name = word().filter(|name| !matches!(*name, "(" | ")")).unwrap_or("").to_owned();
    match opening[3].to_ascii_lowercase().as_str() {
        "domain" => Some(Kind::Domain { name }),
        "problem" => {
            let mut before = "";
            let domain = std::iter::from_fn(word).take(LOOKED_AT).find(|word| {
                let found = before.eq_ignore_ascii_case(":domain");
                before = word;
                found
            });
            Some(Kind::Problem { name, domain: domain.map(str::to_owned) })
        }
        _ => None,
    }
}

/// How many words of a problem are looked at to find its domain, which nearly always comes first.
const LOOKED_AT: usize = 100_000;
