//! A tape of bytes goes in; the text of a tiny MA-PDDL domain and of a problem comes out, full of what is dangerous to compile.
//!
//! Actions name each other and themselves, under all connectives and quantifiers, in preconditions and in `when`s;
//! they delete what others need, and facts are so few that two often want the same one.
//! A shorter tape and smaller bytes make simpler texts. Every text is free of errors.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::tape::Tape;

/// What was written.
#[derive(Debug, Clone)]
pub struct Texts {
    pub domain: String,
    pub problem: String,
}

/// The types of the domain. `Arm` and `Cart` are below `Robot`; without typing all is `Object`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Object,
    Robot,
    Arm,
    Cart,
    Item,
}

/// A variable or an object.
type Term = (String, Kind);

/// A predicate or an action, with the types of its arguments.
#[derive(Debug, Clone)]
struct Symbol {
    name: String,
    kinds: Vec<Kind>,
}

/// How an action says who takes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    /// `?a - t`
    Typed(Kind),
    /// `?a`
    Untyped,
    /// `t`
    Type(Kind),
    /// `a1`
    Constant,
    /// Nobody takes it.
    None,
}

#[expect(clippy::struct_excessive_bools, reason = "each is a feature that a domain has or has not")]
struct Writer<'t> {
    tape: &'t mut Tape,
    typing: bool,
    objects: Vec<Term>,
    /// How many of the objects are constants, of which the first is an agent.
    constants: usize,
    base: Vec<Symbol>,
    /// What is true in the beginning.
    init: Vec<String>,
    derived: Vec<Symbol>,
    actions: Vec<(Symbol, Form)>,
    costs: bool,
    private: bool,
    /// Whether conditions ask who acts; it is the rule, but seldom where there is privacy.
    asks: bool,
    /// How many variables quantifiers have bound.
    bound: usize,
}

/// How often an argument is a new variable although something in scope fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum New {
    Never,
    Seldom,
    /// Mostly so for the first: who acts is mostly somebody else.
    Often,
}

/// Where a condition stands: only those of actions ask about actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Action,
    Elsewhere,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Object => "object",
            Self::Robot => "robot",
            Self::Arm => "arm",
            Self::Cart => "cart",
            Self::Item => "item",
        }
    }

    fn is(self, wanted: Self) -> bool {
        self == wanted
            || wanted == Self::Object
            || wanted == Self::Robot && matches!(self, Self::Arm | Self::Cart)
    }
}

impl Symbol {
    /// `(on ?y0 ?y1)`
    fn head(&self, arguments: &[Term]) -> String {
        let arguments = arguments.iter().map(|(name, _)| name.as_str());
        let words: Vec<&str> = [self.name.as_str()].into_iter().chain(arguments).collect();
        format!("({})", words.join(" "))
    }

    fn formals(&self) -> Vec<Term> {
        (0..self.kinds.len()).map(|at| (format!("?y{at}"), Kind::Object)).collect()
    }
}

/// `?x - item ?y`: what needs no type comes last, since a name without type takes that of the next group.
fn declare(terms: &[Term]) -> String {
    let typed = terms.iter().filter(|(_, kind)| *kind != Kind::Object);
    let typed = typed.map(|(name, kind)| format!("{name} - {}", kind.name()));
    let untyped = terms.iter().filter(|(_, kind)| *kind == Kind::Object);
    typed.chain(untyped.map(|(name, _)| name.clone())).collect::<Vec<_>>().join(" ")
}

impl Texts {
    pub fn new(tape: &mut Tape) -> Self {
        let mut writer = Writer::new(tape);
        let (domain, problem) = (writer.domain(), writer.problem());
        Self { domain, problem }
    }

    /// The same with the goal to come from the state `from` to the state `to`, or to one that looks like it where they differ.
    pub fn towards(
        mut self,
        from: &BTreeSet<String>,
        to: &BTreeSet<String>,
        tape: &mut Tape,
    ) -> Self {
        let gained = to.difference(from).cloned();
        let lost = from.difference(to).map(|fact| format!("(not {fact})"));
        let all: Vec<String> = gained.chain(lost).collect();
        let few = tape.once_in(3);
        let literals: Vec<String> = all.into_iter().filter(|_| !few || tape.once_in(2)).collect();
        let goal = format!("  (:goal (and {}))", literals.join(" "));
        // The first goal has a line of its own.
        let lines = self.problem.lines();
        let lines = lines.map(|line| if line.starts_with("  (:goal (and") { &goal } else { line });
        self.problem = lines.collect::<Vec<_>>().join("\n") + "\n";
        self
    }
}

impl<'t> Writer<'t> {
    fn new(tape: &'t mut Tape) -> Self {
        let typing = !tape.once_in(6);
        let kind = |kind| if typing { kind } else { Kind::Object };
        let mut objects = vec![("a1".to_owned(), kind(Kind::Arm))];
        let other = [Kind::Arm, Kind::Cart][tape.below(2)];
        objects.push(("a2".to_owned(), kind(other)));
        if tape.once_in(3) {
            objects.push(("a3".to_owned(), kind(Kind::Cart)));
        }
        let items = if typing { [1, 0, 2][tape.below(3)] } else { tape.below(2) };
        objects.extend((1..=items).map(|at| (format!("o{at}"), kind(Kind::Item))));
        let constants = tape.below(3).min(2);
        let costs = tape.once_in(3);
        let private = tape.once_in(8);
        let asks = !private || tape.once_in(3);
        let mut writer = Self {
            tape,
            typing,
            objects,
            constants,
            base: Vec::new(),
            init: Vec::new(),
            derived: Vec::new(),
            actions: Vec::new(),
            costs,
            private,
            asks,
            bound: 0,
        };
        writer.base = (0..2 + writer.tape.below(3)).map(|at| writer.predicate("p", at)).collect();
        for (fact, arity) in writer.facts() {
            if writer.tape.once_in([2, 2, 3][arity]) {
                writer.init.push(fact);
            }
        }
        let derived = writer.tape.below(6).saturating_sub(3);
        writer.derived = (0..derived).map(|at| writer.predicate("d", at)).collect();
        writer.actions =
            (0..[2, 1, 3][writer.tape.below(3)]).map(|at| writer.signature(at)).collect();
        writer
    }

    fn predicate(&mut self, letter: &str, at: usize) -> Symbol {
        let arity = [1, 0, 1, 2][self.tape.below(4)];
        Symbol { name: format!("{letter}{at}"), kinds: vec![Kind::Object; arity] }
    }

    fn signature(&mut self, at: usize) -> (Symbol, Form) {
        let form = match self.tape.below(10) {
            4 => Form::Typed(Kind::Arm),
            5 => Form::Untyped,
            6 => Form::Type([Kind::Robot, Kind::Cart][self.tape.below(2)]),
            7 | 8 if self.constants > 0 => Form::Constant,
            // Only where somebody acts may conditions speak of it.
            9 if at > 0 => Form::None,
            _ => Form::Typed(Kind::Robot),
        };
        let form = match form {
            Form::Typed(_) | Form::Type(_) if !self.typing => Form::Untyped,
            form => form,
        };
        let mut kinds = match form {
            Form::Typed(kind) | Form::Type(kind) => vec![kind],
            Form::Untyped => vec![Kind::Object],
            Form::Constant => vec![self.objects[0].1],
            Form::None => Vec::new(),
        };
        match self.tape.below(6) {
            0 | 1 => {}
            5 if self.typing => kinds.extend([Kind::Item, Kind::Item]),
            4 if self.typing => kinds.push(Kind::Robot),
            3 => kinds.push(Kind::Object),
            _ => kinds.push(if self.typing { Kind::Item } else { Kind::Object }),
        }
        (Symbol { name: format!("act{at}"), kinds }, form)
    }

    /// Parameters, of which the order matters.
    fn in_order(&self, terms: &[Term]) -> String {
        let one = |(name, kind): &Term| {
            if self.typing { format!("{name} - {}", kind.name()) } else { name.clone() }
        };
        terms.iter().map(one).collect::<Vec<_>>().join(" ")
    }

    fn fresh(&mut self, kind: Kind) -> Term {
        self.bound += 1;
        (format!("?x{}", self.bound), kind)
    }

    /// An atom over what is in scope and over new variables, which are returned.
    fn atom(&mut self, symbol: &Symbol, scope: &[Term], often: New) -> (String, Vec<Term>) {
        let (mut text, mut new) = (format!("({}", symbol.name), Vec::new());
        for (at, &wanted) in symbol.kinds.iter().enumerate() {
            let constants = self.objects[..self.constants].iter();
            let fitting: Vec<Term> = scope
                .iter()
                .chain(constants)
                .filter(|(_, kind)| kind.is(wanted))
                .cloned()
                .collect();
            let is_new = match often {
                New::Never => false,
                New::Often if at == 0 => !self.tape.once_in(4),
                New::Often | New::Seldom => self.tape.once_in(5),
            };
            let term = if fitting.is_empty() || is_new {
                let term = self.fresh(wanted);
                new.push(term.clone());
                term
            } else {
                let choice = self.tape.below(fitting.len());
                fitting[choice].clone()
            };
            write!(text, " {}", term.0).expect("a string takes all");
        }
        (text + ")", new)
    }

    /// A fact, or its negation; what is new is quantified.
    fn literal(&mut self, scope: &[Term], place: Place) -> String {
        if place == Place::Action && self.asks && self.tape.once_in(3) {
            return self.acting(scope);
        }
        let symbol = self.readable();
        let (atom, new) = self.atom(&symbol, scope, New::Seldom);
        let positive = !self.tape.once_in(3);
        let literal = if positive { atom } else { format!("(not {atom})") };
        self.quantified(literal, &new, positive, scope)
    }

    fn readable(&mut self) -> Symbol {
        let choice = self.tape.below(self.base.len() + self.derived.len());
        self.base.iter().chain(&self.derived).nth(choice).expect("it is below the count").clone()
    }

    /// Somebody does, or nobody does, mostly somebody else.
    fn acting(&mut self, scope: &[Term]) -> String {
        let choice = self.tape.below(self.actions.len());
        let symbol = self.actions[choice].0.clone();
        let (atom, new) = self.atom(&symbol, scope, New::Often);
        let positive = self.tape.once_in(2);
        let literal = if positive { atom } else { format!("(not {atom})") };
        self.quantified(literal, &new, positive, scope)
    }

    fn quantified(
        &mut self,
        literal: String,
        new: &[Term],
        positive: bool,
        scope: &[Term],
    ) -> String {
        let Some((variable, _)) = new.first() else { return literal };
        let exists = positive != self.tape.once_in(6);
        let mut parts = vec![literal];
        if let Some((own, _)) = scope.first()
            && self.tape.once_in(2)
        {
            parts.push(format!("(= {own} {variable})"));
        }
        if self.tape.once_in(3) {
            let (symbol, inner) = (self.readable(), [new, scope].concat());
            let fact = self.atom(&symbol, &inner, New::Never).0;
            parts.push(if self.tape.once_in(3) { fact } else { format!("(not {fact})") });
        }
        let flip = |part: &String| match part.strip_prefix("(not ") {
            Some(rest) => rest[..rest.len() - 1].to_owned(),
            None => format!("(not {part})"),
        };
        let body = match (exists, parts.len()) {
            (_, 1) => parts.remove(0),
            (true, _) => {
                let rest: Vec<_> = parts[1..].iter().map(flip).collect();
                format!("(and {} {})", rest.join(" "), parts[0])
            }
            (false, 2) => format!("(imply {} {})", flip(&parts[1]), parts[0]),
            (false, _) => format!("(or {})", parts.join(" ")),
        };
        let quantifier = if exists { "exists" } else { "forall" };
        format!("({quantifier} ({}) {body})", declare(new))
    }

    fn formula(&mut self, scope: &[Term], depth: usize, place: Place) -> String {
        let choice = if depth == 0 { 0 } else { self.tape.below(12) };
        let below = |writer: &mut Self| writer.formula(scope, depth - 1, place);
        match choice {
            6 => format!("(and {} {})", below(self), below(self)),
            7 => format!("(or {} {})", below(self), below(self)),
            8 => format!("(not {})", below(self)),
            9 => format!("(imply {} {})", below(self), below(self)),
            10 => {
                let kind = if self.typing { Kind::Robot } else { Kind::Object };
                let new = self.fresh(kind);
                let quantifier = ["exists", "forall"][self.tape.below(2)];
                let body =
                    self.formula(&[std::slice::from_ref(&new), scope].concat(), depth - 1, place);
                format!("({quantifier} ({}) {body})", declare(&[new]))
            }
            11 if scope.len() > 1 => {
                let equal = format!("(= {} {})", scope[0].0, scope[1].0);
                if self.tape.once_in(3) { equal } else { format!("(not {equal})") }
            }
            _ => self.literal(scope, place),
        }
    }

    fn domain(&mut self) -> String {
        let flags = [
            (self.private, " :unfactored-privacy"),
            (!self.derived.is_empty(), " :derived-predicates"),
            (self.costs, " :action-costs"),
        ];
        let flags: String =
            flags.into_iter().filter(|(used, _)| *used).map(|(_, flag)| flag).collect();
        let mut lines = vec![
            "(define (domain tiny)".to_owned(),
            format!("(:requirements :adl :multi-agent{flags})"),
        ];
        if self.typing {
            lines.push("(:types arm cart - robot robot item - object)".to_owned());
        }
        if self.constants > 0 {
            lines.push(format!("(:constants {})", declare(&self.objects[..self.constants])));
        }
        let symbols = self.base.iter().chain(&self.derived);
        let predicates: Vec<_> = symbols.map(|symbol| symbol.head(&symbol.formals())).collect();
        lines.push(format!("(:predicates {})", predicates.join(" ")));
        if self.costs {
            lines.push("(:functions (total-cost) - number (price ?y0) - number)".to_owned());
        }
        lines.extend(self.rules());
        for (symbol, form) in self.actions.clone() {
            lines.push(self.action(&symbol, form));
        }
        lines.join("\n  ") + "\n)\n"
    }

    /// Each derived predicate depends on the base, on those before it, and sometimes on itself.
    fn rules(&mut self) -> Vec<String> {
        let derived = std::mem::take(&mut self.derived);
        let mut rules = Vec::new();
        for symbol in derived {
            let scope = symbol.formals();
            let mut body = self.formula(&scope, 2, Place::Elsewhere);
            if self.tape.once_in(3) {
                let (own, mut new) = self.atom(&symbol, &scope, New::Often);
                let inner = [new.as_slice(), &scope].concat();
                let link = self.base[self.tape.below(self.base.len())].clone();
                let (link, more) = self.atom(&link, &inner, New::Seldom);
                new.extend(more);
                let step = format!("(and {link} {own})");
                let step = if new.is_empty() {
                    step
                } else {
                    format!("(exists ({}) {step})", declare(&new))
                };
                body = format!("(or {body} {step})");
            }
            rules.push(format!("(:derived {} {body})", symbol.head(&scope)));
            self.derived.push(symbol);
        }
        rules
    }

    fn action(&mut self, symbol: &Symbol, form: Form) -> String {
        let mut text = format!("(:action {}", symbol.name);
        let mut scope = Vec::new();
        match form {
            Form::Typed(kind) => scope.push(("?a".to_owned(), kind)),
            Form::Untyped => scope.push(("?a".to_owned(), Kind::Object)),
            Form::Type(_) | Form::Constant | Form::None => {}
        }
        match form {
            Form::Typed(kind) => text.extend([" :agent ?a - ", kind.name()]),
            Form::Untyped => text.push_str(" :agent ?a"),
            Form::Type(kind) => text.extend([" :agent ", kind.name()]),
            Form::Constant => text.extend([" :agent ", &self.objects[0].0]),
            Form::None => {}
        }
        let skipped = usize::from(form != Form::None);
        let parameters: Vec<Term> = symbol.kinds[skipped..]
            .iter()
            .enumerate()
            .map(|(at, &kind)| (format!("?p{at}"), kind))
            .collect();
        if !parameters.is_empty() || self.tape.once_in(2) {
            text.extend([" :parameters (", &self.in_order(&parameters), ")"]);
        }
        scope.extend(parameters);
        let mut conditions = Vec::new();
        let mut effects = Vec::new();
        // What others may want as well is used up, and what another action wants is made of it.
        if self.tape.once_in(2) {
            let links = [self.tape.below(self.base.len()), self.tape.below(self.base.len())];
            let [(fact, new), (made, more)] = links.map(|at| {
                let symbol = self.base[at].clone();
                self.atom(&symbol, &scope, New::Never)
            });
            if new.is_empty() && more.is_empty() {
                conditions.push(fact.clone());
                effects.push(made.clone());
                if fact != made {
                    effects.push(format!("(not {fact})"));
                }
            }
        }
        if self.asks && self.tape.below(5) > 2 {
            conditions.push(self.acting(&scope));
        }
        for _ in 0..[0, 1, 0, 2][self.tape.below(4)] {
            conditions.push(self.formula(&scope, 2, Place::Action));
        }
        for _ in 0..=self.tape.below(3) {
            effects.push(self.effect(&scope));
        }
        if self.costs {
            effects.push(self.increase(&scope));
        }
        match conditions.as_slice() {
            [] => {}
            [one] => text.extend(["\n    :precondition ", one]),
            more => text.extend(["\n    :precondition (and ", &more.join(" "), ")"]),
        }
        format!("{text}\n    :effect (and {}))", effects.join(" "))
    }

    /// An add or a delete, perhaps under a condition.
    fn effect(&mut self, scope: &[Term]) -> String {
        let symbol = self.base[self.tape.below(self.base.len())].clone();
        let (atom, new) = self.atom(&symbol, scope, New::Seldom);
        let mut effect = if self.tape.once_in(3) { format!("(not {atom})") } else { atom };
        if self.tape.once_in(3) {
            let inner = [new.as_slice(), scope].concat();
            let acting = self.asks && self.tape.once_in(2);
            let condition =
                if acting { self.acting(&inner) } else { self.formula(&inner, 1, Place::Action) };
            effect = format!("(when {condition} {effect})");
        }
        if new.is_empty() { effect } else { format!("(forall ({}) {effect})", declare(&new)) }
    }

    fn increase(&mut self, scope: &[Term]) -> String {
        let by = match scope.first() {
            Some((term, _)) if self.tape.once_in(3) => format!("(price {term})"),
            _ => self.tape.below(5).to_string(),
        };
        format!("(increase (total-cost) {by})")
    }

    fn problem(&mut self) -> String {
        let mut objects = self.objects[self.constants..].to_vec();
        let hidden = self.private && self.constants < 2;
        let private = hidden.then(|| objects.remove(1 - self.constants));
        let private = private.map_or(String::new(), |agent| {
            format!(" (:private {} {})", agent.0, self.in_order(std::slice::from_ref(&agent)))
        });
        let mut init = self.init.clone();
        if self.costs {
            init.push("(= (total-cost) 0)".to_owned());
            for (name, _) in &self.objects {
                init.push(format!("(= (price {name}) {})", self.tape.below(4)));
            }
        }
        let mut lines = vec![
            "(define (problem one)".to_owned(),
            "(:domain tiny)".to_owned(),
            format!("(:objects {}{private})", declare(&objects)),
            format!("(:init {})", init.join(" ")),
            format!("(:goal (and {}))", self.goals().join(" ")),
        ];
        if self.tape.once_in(6) {
            let kind = if self.typing { Kind::Robot } else { Kind::Object };
            let own = [("?a".to_owned(), kind)];
            let goal = self.literal(&own, Place::Elsewhere);
            lines.push(format!("(:goal :agent {} :condition {goal})", declare(&own)));
        }
        if self.costs {
            lines.push("(:metric minimize (total-cost))".to_owned());
        }
        lines.join("\n  ") + "\n)\n"
    }

    fn goals(&mut self) -> Vec<String> {
        let (all, mut goals) = (self.facts(), Vec::new());
        for _ in 0..=self.tape.below(2) {
            let fact = all[self.tape.below(all.len())].0.clone();
            // What holds already is seldom a goal.
            let positive = self.init.contains(&fact) == self.tape.once_in(5);
            goals.push(if positive { fact } else { format!("(not {fact})") });
        }
        if self.tape.once_in(3) {
            goals.push(self.formula(&[], 2, Place::Elsewhere));
        }
        goals
    }

    /// All ground facts that are not derived, each with its arity.
    fn facts(&self) -> Vec<(String, usize)> {
        let mut facts = Vec::new();
        for symbol in &self.base {
            let mut tuples = vec![String::new()];
            for _ in &symbol.kinds {
                let longer = |tuple: &String| {
                    self.objects
                        .iter()
                        .map(|(name, _)| format!("{tuple} {name}"))
                        .collect::<Vec<_>>()
                };
                tuples = tuples.iter().flat_map(longer).collect();
            }
            let arity = symbol.kinds.len();
            facts.extend(tuples.iter().map(|tuple| (format!("({}{tuple})", symbol.name), arity)));
        }
        facts
    }
}
