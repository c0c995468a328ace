//! Actions of all kinds, and the fields of everything that has fields.

use super::list::Names;
use super::{Reader, is_number, lower};
use crate::ast::{Action, ActionKind, Feature, Formula, Name, TypedList};
use crate::diagnostic::{
    duplicate_field, invalid_duration, missing_duration, several_formulas, unexpected_item,
    unknown_field,
};
use crate::near::nearest;
use crate::source::Span;
use crate::tree::NodeId;

/// The fields of an action.
const ACTION: [&str; 11] = [
    ":parameters",
    ":precondition",
    ":effect",
    ":agent",
    ":vars",
    ":context",
    ":expansion",
    ":observe",
    ":constraints",
    ":only-in-expansions",
    ":comment",
];

/// The fields of a durative action.
const DURATIVE: [&str; 6] =
    [":parameters", ":duration", ":condition", ":effect", ":agent", ":comment"];

/// The fields of a process or an event.
const CHANGE: [&str; 4] = [":parameters", ":precondition", ":effect", ":comment"];

/// What has fields, while they are read.
pub(super) struct Fields<'a> {
    /// As messages say it: "action `drive`".
    pub(super) owner: String,
    /// The fields that it may have.
    pub(super) known: &'static [&'static str],
    /// The fields that it has, with the place of their keywords.
    seen: Vec<(&'static str, Span)>,
    /// The parts that are still to be read.
    parts: std::vec::IntoIter<NodeId>,
    /// The keyword of the field at hand.
    keyword: Name<'a>,
}

impl Fields<'_> {
    /// Whether the field has been read.
    pub(super) fn has(&self, field: &str) -> bool {
        self.seen.iter().any(|&(seen, _)| seen == field)
    }
}

impl<'a> Reader<'a, '_> {
    /// The fields in a list; the first `skip` parts of it are no fields.
    pub(super) fn fields(
        &self,
        item: NodeId,
        skip: usize,
        owner: String,
        known: &'static [&'static str],
    ) -> Fields<'a> {
        let parts: Vec<NodeId> = self.tree.children(item).skip(skip).collect();
        let keyword = self.name(item);
        Fields { owner, known, seen: Vec::new(), parts: parts.into_iter(), keyword }
    }

    /// The next field and its values; nothing at the end.
    pub(super) fn next_field(
        &mut self,
        fields: &mut Fields<'a>,
    ) -> Option<(&'static str, Name<'a>, Vec<NodeId>)> {
        loop {
            let part = fields.parts.next()?;
            let field = self.field(part, fields);
            fields.keyword = self.name(part);
            let values = self.values(field, fields);
            let Some(field) = field else { continue };
            let keyword = fields.keyword;
            let repeated = fields.seen.iter().find(|&&(other, _)| other == field);
            if let Some(&(_, first)) = repeated {
                self.diagnostics.push(duplicate_field::duplicate_field(
                    field,
                    &fields.owner,
                    keyword.span,
                    first,
                ));
            } else {
                fields.seen.push((field, keyword.span));
            }
            return Some((field, keyword, values));
        }
    }

    /// The parts up to the next field.
    fn values(&self, field: Option<&str>, fields: &mut Fields<'a>) -> Vec<NodeId> {
        let rest = fields.parts.as_slice();
        let count = (0..rest.len()).find(|&at| self.starts_field(rest, at, field, fields.known));
        let count = count.unwrap_or(rest.len());
        fields.parts.by_ref().take(count).collect()
    }

    /// Whether the part at `at`, after the keyword of `field`, is the keyword of another field, perhaps without its colon.
    fn starts_field(
        &self,
        parts: &[NodeId],
        at: usize,
        field: Option<&str>,
        known: &[&str],
    ) -> bool {
        let tree = self.tree;
        let word = tree.slice(parts[at]);
        if tree.is_list(parts[at]) || word.starts_with(':') {
            return !tree.is_list(parts[at]);
        }
        // The value of `:agent` is no list: in `:agent ?a - agent` the last word is a type.
        let named = field != Some(":agent")
            && known.iter().any(|field| field[1..].eq_ignore_ascii_case(word));
        // Words beside it make it a word of a sentence.
        let alone = at == 0 || tree.is_list(parts[at - 1]);
        let valued = parts
            .get(at + 1)
            .is_some_and(|&value| tree.is_list(value) || word.eq_ignore_ascii_case("agent"));
        named && alone && valued
    }

    /// The field that a word starts, taken as the one that was probably meant.
    fn field(&mut self, part: NodeId, fields: &Fields<'a>) -> Option<&'static str> {
        if self.tree.is_list(part) {
            self.unexpected("a field such as `:parameters`", part);
            return None;
        }
        let word = self.name(part);
        let known = fields.known;
        if let Some(&field) = known.iter().find(|field| word.is(field)) {
            return Some(field);
        }
        let near = nearest(word.text, known.iter().copied())
            .and_then(|near| known.iter().copied().find(|&field| field == near))
            .or_else(|| known.iter().copied().find(|field| word.is(&field[1..])))
            .or_else(|| other_name(word, known));
        self.diagnostics.push(unknown_field::unknown_field(
            &fields.owner,
            word.text,
            word.span,
            near,
        ));
        near
    }

    /// The one list that a field like `:parameters` has.
    pub(super) fn parameters(&mut self, values: &[NodeId], list: &mut TypedList<'a>) {
        for (index, &value) in values.iter().enumerate() {
            if index == 0 && self.tree.is_list(value) {
                let read = self.typed_list(self.tree.children(value), Names::Variables);
                list.groups.extend(read.groups);
            } else {
                self.unexpected("one list of parameters", value);
            }
        }
    }

    /// The one formula that a field like `:precondition` has.
    pub(super) fn formulas(
        &mut self,
        field: &str,
        values: &[NodeId],
        formulas: &mut Vec<Formula<'a>>,
    ) {
        let mut read = 0;
        for (index, &value) in values.iter().enumerate() {
            if value.0 < read {
                continue;
            }
            read = self.reach(value);
            if index > 0 && !self.tree.is_list(value) {
                self.stray("a field such as `:effect`", value);
                continue;
            }
            if index > 0 {
                let span = self.opening(value);
                self.diagnostics.push(several_formulas::several_formulas(field, span));
            }
            let formula = self.formula(value);
            formulas.push(formula);
        }
    }

    /// The word after the keyword of a section, and how many words that are.
    pub(super) fn title_of(&mut self, item: NodeId, what: &str) -> (Name<'a>, usize) {
        let tree = self.tree;
        let mut parts = tree.children(item);
        let keyword = parts.next().map_or(tree.span(item), |keyword| tree.span(keyword));
        let name =
            parts.next().filter(|&part| !tree.is_list(part) && !tree.slice(part).starts_with(':'));
        if let Some(name) = name {
            return (self.name(name), 2);
        }
        let expected = format!("the name of the {what}");
        self.diagnostics.push(unexpected_item::missing_item(&expected, keyword));
        (Name { text: "", span: keyword }, 1)
    }

    /// `(:action NAME …)` and what is built like it.
    pub(super) fn action(&mut self, kind: ActionKind, item: NodeId) -> Action<'a> {
        let (name, skip) = self.title_of(item, kind.describe());
        let owner = format!("{} `{name}`", kind.describe());
        let known: &[&str] = match kind {
            ActionKind::Instant => &ACTION,
            ActionKind::Durative => &DURATIVE,
            ActionKind::Process | ActionKind::Event => &CHANGE,
        };
        let mut fields = self.fields(item, skip, owner, known);
        let mut action = Action {
            kind,
            name,
            agent: None,
            parameters: TypedList::default(),
            durations: Vec::new(),
            preconditions: Vec::new(),
            effects: Vec::new(),
            unread: Vec::new(),
            place: self.place(item),
        };
        let mut timed = false;
        let mut after = name.span;
        while let Some((field, keyword, values)) = self.next_field(&mut fields) {
            match field {
                ":parameters" => {
                    self.parameters(&values, &mut action.parameters);
                    after = values.last().map_or(keyword.span, |&last| self.tree.span(last));
                }
                ":precondition" | ":condition" => {
                    self.formulas(field, &values, &mut action.preconditions);
                }
                ":effect" => self.formulas(field, &values, &mut action.effects),
                ":duration" => {
                    timed = true;
                    match values.as_slice() {
                        &[value] if !self.tree.is_list(value) => {
                            let (text, span) = (self.tree.slice(value), self.tree.span(value));
                            let number = is_number(text).then_some(text);
                            self.diagnostics.push(invalid_duration::not_a_constraint(number, span));
                        }
                        _ => self.formulas(field, &values, &mut action.durations),
                    }
                }
                ":agent" => action.agent = self.agent(keyword, &values).or(action.agent),
                ":comment" => {}
                _ => {
                    let feature = match lower(field, &mut [0; 24]) {
                        ":observe" => Feature::Nondeterminism,
                        ":constraints" => Feature::Constraints,
                        _ => Feature::Axioms,
                    };
                    if let Some(&value) = values.first() {
                        action.unread.push(self.unread(feature, keyword, value));
                    }
                }
            }
        }
        if kind == ActionKind::Durative && !timed && !name.text.is_empty() {
            let place = Span { start: after.end, ..after };
            let missing = missing_duration::missing_duration(name.text, name.span, place);
            self.diagnostics.push(missing);
        }
        action
    }
}

/// What a field is called in another kind of action.
fn other_name(word: Name<'_>, known: &[&'static str]) -> Option<&'static str> {
    let meant: &[&str] = match word.text.trim_start_matches(':').to_ascii_lowercase().as_str() {
        "precondition" | "preconditions" | "condition" | "conditions" | "pre" => {
            &[":precondition", ":condition"]
        }
        "post" | "postcondition" | "postconditions" => &[":effect"],
        _ => &[],
    };
    known.iter().copied().find(|field| meant.contains(field))
}
