//! The text of a trace and the domain whose words it uses go in; a [`Trace`] comes out, with what is wrong in the text.
//!
//! Two forms are read, and mixtures of them:
//!
//! ```text
//! (:trajectory (:state (on a b) …) (:action (unstack a b)) (:state …) …)                    AMLGym and SAM
//! ((:init (on a b) …) (operators: (unstack a1 a b) (nop ) …) (:state …) …)                   MA-SAM
//! ```
//!
//! A state lists all that holds. An `(:objects a b - TYPE …)` may stand before the first one.

use lang::model::{ActionId, Domain, Object, ObjectId, PredicateId, TypeId, Variable};
use lang::plan::Step;
use rustc_hash::FxHashMap;

use super::fault::Fault;
use super::scan::{Item, Scanner};
use super::{FactId, Joint, Trace, vocabulary};

/// What is known before a text is read, and what to do about mistakes.
#[derive(Debug, Clone, Copy, Default)]
pub struct Reading<'r> {
    /// What the trace is called.
    pub name: &'r str,
    /// The objects of the problem, the constants of the domain first. Without them, objects are what the text mentions:
    /// each has the most specific of the types of the positions in which it stands.
    pub objects: Option<&'r [Object]>,
    /// Who acts in each slot of a joint step. Without them, an agent is who is the first argument of all that a slot does.
    pub agents: &'r [&'r str],
    /// Leave out what is wrong and read on; otherwise reading ends at the first mistake.
    pub skip: bool,
}

/// What stands where an agent does nothing.
const IDLE: [&str; 3] = ["nop", "no-op", "noop"];

/// Reads a trace. There is always one: it holds what could be used.
pub fn read(text: &str, domain: &Domain, reading: &Reading<'_>) -> (Trace, Vec<Fault>) {
    let mut reader = Reader::new(text, domain, reading);
    // The faults say why reading ended early.
    let _ = reader.trace();
    reader.finish()
}

/// Reading does not go on.
struct Stop;

/// A kind of section.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    State,
    Step,
    Objects,
}

fn section(word: &str) -> Option<Section> {
    match word.trim_matches(':').to_ascii_lowercase().as_str() {
        "state" | "init" => Some(Section::State),
        "action" | "actions" | "operator" | "operators" => Some(Section::Step),
        "objects" => Some(Section::Objects),
        _ => None,
    }
}

struct Reader<'t, 'd> {
    scanner: Scanner<'t>,
    domain: &'d Domain,
    reading: &'d Reading<'d>,
    predicates: FxHashMap<String, PredicateId>,
    actions: FxHashMap<String, ActionId>,
    objects: FxHashMap<String, ObjectId>,
    /// The types of the positions in which an object stands, where its own are not given.
    stands: Vec<Vec<&'d [TypeId]>>,
    /// How many objects have given types.
    given: usize,
    /// Facts by their text; none for those that are wrong, which have been told.
    facts: FxHashMap<&'t str, Option<FactId>>,
    faults: Vec<Fault>,
    trace: Trace,
}

impl<'t, 'd> Reader<'t, 'd> {
    fn new(text: &'t str, domain: &'d Domain, reading: &'d Reading<'d>) -> Self {
        let lower = |text: &str| text.to_ascii_lowercase();
        let mut trace = Trace::new(reading.name, domain);
        if let Some(objects) = reading.objects {
            trace.objects = objects.to_vec();
        }
        let names = trace.objects.iter().enumerate();
        let objects = names.map(|(at, one)| (lower(&one.name.text), ObjectId(at as u32)));
        let predicates = domain.predicates.iter().enumerate();
        let actions = domain.actions.iter().enumerate();
        Self {
            scanner: Scanner::new(text),
            domain,
            reading,
            predicates: predicates
                .map(|(at, one)| (lower(&one.name.text), PredicateId(at as u32)))
                .collect(),
            actions: actions
                .map(|(at, one)| (lower(&one.name.text), ActionId(at as u32)))
                .collect(),
            objects: objects.collect(),
            stands: vec![Vec::new(); trace.objects.len()],
            given: trace.objects.len(),
            facts: FxHashMap::default(),
            faults: Vec::new(),
            trace,
        }
    }

    /// Notes a mistake; an error if reading shall end there.
    fn fault(&mut self, place: usize, message: impl Into<String>) -> Result<(), Stop> {
        self.faults.push(Fault::at(self.scanner.text, place, message));
        if self.reading.skip { Ok(()) } else { Err(Stop) }
    }

    fn ended(&mut self) -> Stop {
        let end = self.scanner.text.len();
        // This ends reading in any case.
        let _ = self.fault(end, "the text ends inside a list");
        Stop
    }

    fn trace(&mut self) -> Result<(), Stop> {
        let place = self.scanner.place();
        match self.scanner.next() {
            Some(Item::Open) => {}
            Some(_) => {
                self.fault(place, "a trace begins with `(`")?;
                return Err(Stop);
            }
            None => {
                self.fault(place, "there is no trace in this text")?;
                return Err(Stop);
            }
        }
        if let Some(Item::Word(word)) = self.scanner.peek() {
            if word.trim_matches(':').eq_ignore_ascii_case("trajectory") {
                self.scanner.next();
            } else {
                let message =
                    format!("a trace begins with `(:trajectory` or `((`, not with `({word}`");
                self.fault(place, message)?;
                return Err(Stop);
            }
        }
        loop {
            let place = self.scanner.place();
            match self.scanner.next() {
                Some(Item::Open) => self.part(place)?,
                Some(Item::Word(word)) => {
                    self.fault(place, format!("`{word}` stands outside of a list"))?;
                }
                Some(Item::Close) => break,
                None => return Err(self.ended()),
            }
        }
        let place = self.scanner.place();
        if self.scanner.next().is_some() {
            self.fault(place, "this stands behind the end of the trace")?;
        }
        if self.trace.states.is_empty() {
            self.fault(place, "there is no state in this trace")?;
        }
        Ok(())
    }

    /// One section, whose parenthesis at `place` is read.
    fn part(&mut self, place: usize) -> Result<(), Stop> {
        let head = match self.scanner.next() {
            Some(Item::Word(word)) => word,
            Some(Item::Close) => return self.fault(place, "an empty list is no part of a trace"),
            _ => {
                self.fault(place, "a part of a trace begins with `:state` or `:action`")?;
                return self.leave(2);
            }
        };
        match section(head) {
            Some(Section::State) => self.state(place),
            Some(Section::Step) => self.step(place),
            Some(Section::Objects) => self.declared(place),
            None => {
                let message = format!("`{head}` is no part of a trace: `:state` and `:action` are");
                self.fault(place, message)?;
                self.leave(1)
            }
        }
    }

    fn leave(&mut self, lists: u32) -> Result<(), Stop> {
        for _ in 0..lists {
            if !self.scanner.leave() {
                return Err(self.ended());
            }
        }
        Ok(())
    }

    fn state(&mut self, place: usize) -> Result<(), Stop> {
        let mut facts = Vec::new();
        loop {
            let place = self.scanner.place();
            match self.scanner.next() {
                Some(Item::Open) => facts.extend(self.fact(place)?),
                Some(Item::Close) => break,
                Some(Item::Word(word)) => {
                    self.fault(place, format!("`{word}` is no fact: facts stand in parentheses"))?;
                }
                None => return Err(self.ended()),
            }
        }
        if self.trace.states.len() > self.trace.steps.len() {
            self.fault(place, "two states follow each other, and nothing was done between them")?;
            self.trace.step(Joint::default());
        }
        self.trace.state(facts);
        Ok(())
    }

    /// One fact, whose parenthesis at `place` is read; none for what says nothing.
    fn fact(&mut self, place: usize) -> Result<Option<FactId>, Stop> {
        let Some(text) = self.scanner.flat() else {
            let head = self.scanner.next();
            match head {
                // That something does not hold is what its absence says anyway.
                Some(Item::Word(word)) if word.eq_ignore_ascii_case("not") => {}
                Some(Item::Word("=")) => self.fault(place, "nothing is learned about numbers")?,
                None => return Err(self.ended()),
                _ => self.fault(place, "this is no fact")?,
            }
            self.leave(if head == Some(Item::Open) { 2 } else { 1 })?;
            return Ok(None);
        };
        if let Some(&known) = self.facts.get(text) {
            return Ok(known);
        }
        let made = self.make(text, place)?;
        self.facts.insert(text, made);
        Ok(made)
    }

    fn make(&mut self, text: &'t str, place: usize) -> Result<Option<FactId>, Stop> {
        let mut words = text.split_ascii_whitespace();
        let Some(name) = words.next() else {
            self.fault(place, "an empty list is no fact")?;
            return Ok(None);
        };
        let Some(&predicate) = self.predicates.get(&name.to_ascii_lowercase()) else {
            let known = self.domain.predicates.iter().map(|one| one.name.text.as_str());
            let message = unknown("predicate", name, known);
            self.fault(place, message)?;
            return Ok(None);
        };
        let domain = self.domain;
        let parameters = &domain.predicates[predicate.index()].parameters;
        let arguments = self.arguments(words, parameters, name, place)?;
        Ok(arguments.map(|arguments| self.trace.fact(predicate, &arguments)))
    }

    /// The objects that `words` name, if they fit.
    fn arguments(
        &mut self,
        words: std::str::SplitAsciiWhitespace<'t>,
        parameters: &'d [Variable],
        head: &str,
        place: usize,
    ) -> Result<Option<Vec<ObjectId>>, Stop> {
        let words: Vec<&str> = words.collect();
        if words.len() != parameters.len() {
            let (found, wanted) = (words.len(), parameters.len());
            let message = format!("`{head}` takes {wanted} arguments, and here are {found}");
            self.fault(place, message)?;
            return Ok(None);
        }
        let mut arguments = Vec::with_capacity(words.len());
        for (word, parameter) in words.into_iter().zip(parameters) {
            let Some(object) = self.object(word) else {
                let known = self.trace.objects.iter().map(|one| one.name.text.as_str());
                let message = unknown("object", word, known);
                self.fault(place, message)?;
                return Ok(None);
            };
            if object.index() >= self.given {
                self.stand(object, &parameter.types);
            } else if !self.domain.has_type(&self.trace.objects[object.index()], &parameter.types) {
                let wanted: Vec<&str> = parameter
                    .types
                    .iter()
                    .map(|id| self.domain.types[id.index()].name.text.as_str())
                    .collect();
                let message =
                    format!("`{word}` in `{head}` is not of the type {}", wanted.join(" or "));
                self.fault(place, message)?;
                return Ok(None);
            }
            arguments.push(object);
        }
        Ok(Some(arguments))
    }

    /// The object of this name, which is a new one if the objects are not given.
    fn object(&mut self, word: &str) -> Option<ObjectId> {
        let lower = word.to_ascii_lowercase();
        if let Some(&known) = self.objects.get(&lower) {
            return Some(known);
        }
        if self.reading.objects.is_some() {
            return None;
        }
        let id = ObjectId(self.trace.objects.len() as u32);
        self.trace.objects.push(vocabulary::object(word, Vec::new()));
        self.stands.push(Vec::new());
        self.objects.insert(lower, id);
        Some(id)
    }

    fn stand(&mut self, object: ObjectId, types: &'d [TypeId]) {
        let stands = &mut self.stands[object.index()];
        if !stands.contains(&types) {
            stands.push(types);
        }
    }

    /// What is done in a step, whose head is read: one list for each agent, or the words of a single action.
    fn step(&mut self, place: usize) -> Result<(), Stop> {
        let mut joint = Joint { parts: Vec::new(), whole: true };
        if let Some(Item::Word(_)) = self.scanner.peek() {
            self.action(place, &mut joint)?;
        } else {
            loop {
                let place = self.scanner.place();
                match self.scanner.next() {
                    Some(Item::Open) => self.action(place, &mut joint)?,
                    Some(Item::Close) => break,
                    Some(Item::Word(word)) => {
                        self.fault(place, format!("`{word}` stands outside of an action"))?;
                    }
                    None => return Err(self.ended()),
                }
            }
        }
        let agents = self.reading.agents.len();
        if agents > 0 && joint.parts.len() != agents {
            let parts = joint.parts.len();
            self.fault(place, format!("here are {parts} actions of {agents} agents"))?;
            joint.parts.resize(agents, None);
            joint.whole = false;
        }
        if self.trace.steps.len() >= self.trace.states.len() {
            return self.fault(place, "there is no state before this step");
        }
        self.trace.step(joint);
        Ok(())
    }

    /// One action up to its closing parenthesis.
    fn action(&mut self, place: usize, joint: &mut Joint) -> Result<(), Stop> {
        let Some(text) = self.scanner.flat() else {
            joint.parts.push(None);
            joint.whole = false;
            self.fault(place, "this is no action")?;
            return self.leave(1);
        };
        let mut words = text.split_ascii_whitespace();
        let name = words.next().unwrap_or_default();
        let Some(&action) = self.actions.get(&name.to_ascii_lowercase()) else {
            joint.parts.push(None);
            if IDLE.iter().any(|idle| idle.eq_ignore_ascii_case(name)) {
                return Ok(());
            }
            joint.whole = false;
            let known = self.domain.actions.iter().map(|one| one.name.text.as_str());
            let message = unknown("action", name, known);
            return self.fault(place, message);
        };
        let domain = self.domain;
        let scope = &domain.actions[action.index()].scope;
        let parameters = &scope.variables[..scope.parameters as usize];
        let arguments = self.arguments(words, parameters, name, place)?;
        joint.whole &= arguments.is_some();
        joint.parts.push(arguments.map(|arguments| Step { action, arguments: arguments.into() }));
        Ok(())
    }

    /// `(:objects a b - TYPE …)`, whose head is read.
    fn declared(&mut self, place: usize) -> Result<(), Stop> {
        if !self.trace.states.is_empty() {
            self.fault(place, "objects stand before the first state")?;
        }
        let mut open: Vec<(&str, usize)> = Vec::new();
        loop {
            let place = self.scanner.place();
            match self.scanner.next() {
                Some(Item::Word("-")) => {
                    let place = self.scanner.place();
                    let Some(Item::Word(word)) = self.scanner.next() else {
                        self.fault(place, "a type stands behind `-`")?;
                        return self.leave(1);
                    };
                    let types = &self.domain.types;
                    let known =
                        types.iter().position(|one| one.name.text.eq_ignore_ascii_case(word));
                    if known.is_none() {
                        let near = types.iter().map(|one| one.name.text.as_str());
                        let message = unknown("type", word, near);
                        self.fault(place, message)?;
                    }
                    let kind = TypeId(known.unwrap_or(0) as u32);
                    open.drain(..).for_each(|(name, _)| self.declare(name, kind));
                }
                Some(Item::Word(word)) => open.push((word, place)),
                Some(Item::Close) => break,
                Some(Item::Open) => {
                    self.fault(place, "a name stands here")?;
                    self.leave(1)?;
                }
                None => return Err(self.ended()),
            }
        }
        open.drain(..).for_each(|(name, _)| self.declare(name, TypeId(0)));
        self.given = self.trace.objects.len();
        Ok(())
    }

    fn declare(&mut self, name: &str, kind: TypeId) {
        // What the problem says of an object, or the domain of a constant, counts for more.
        if !self.objects.contains_key(&name.to_ascii_lowercase()) {
            let id = ObjectId(self.trace.objects.len() as u32);
            self.trace.objects.push(vocabulary::object(name, vec![kind]));
            self.stands.push(Vec::new());
            self.objects.insert(name.to_ascii_lowercase(), id);
        }
    }

    /// Settles types and agents, which are known only when all is read.
    fn finish(mut self) -> (Trace, Vec<Fault>) {
        let domain = self.domain;
        for at in self.given..self.trace.objects.len() {
            self.trace.objects[at].types = narrowest(domain, &self.stands[at]);
        }
        let names = self.trace.objects.iter().map(|one| one.name.text.as_str());
        let named = self.reading.agents.iter().map(|name| {
            let known = self.objects.get(&name.to_ascii_lowercase()).copied();
            known.ok_or_else(|| unknown("object", name, names.clone()))
        });
        match named.collect::<Result<Vec<ObjectId>, String>>() {
            Ok(agents) => self.trace.agents = agents,
            Err(message) => self.faults.push(Fault::at(self.scanner.text, 0, message)),
        }
        if self.reading.agents.is_empty() {
            self.trace.agents = actors(&self.trace).unwrap_or_default();
        }
        self.faults.sort_by_key(|fault| (fault.line, fault.column));
        (self.trace, self.faults)
    }
}

fn unknown<'k>(what: &str, name: &str, known: impl Iterator<Item = &'k str>) -> String {
    format!("unknown {what} `{name}`{}", lang::did_you_mean(name, known))
}

/// The most specific types among those of the positions in which an object stands.
fn narrowest(domain: &Domain, stands: &[&[TypeId]]) -> Vec<TypeId> {
    // Where one of several types is asked for, the object may be of any of them: that says least.
    let single = stands.iter().filter(|types| types.len() == 1);
    let mut all: Vec<TypeId> = single.map(|types| types[0]).collect();
    if all.is_empty() {
        all = stands.iter().filter_map(|types| types.first().copied()).take(1).collect();
    }
    let above = |id: &TypeId| all.iter().any(|other| other != id && domain.is_subtype(*other, *id));
    let mut types: Vec<TypeId> = all.iter().filter(|id| !above(id)).copied().collect();
    types.sort_unstable();
    types.dedup();
    if types.is_empty() { vec![TypeId(0)] } else { types }
}

/// For each slot who is the first argument of all that is done in it, if that is somebody else in each.
fn actors(trace: &Trace) -> Option<Vec<ObjectId>> {
    let slots =
        trace.steps.iter().map(|joint| joint.parts.len()).max().filter(|slots| *slots > 1)?;
    let mut actors: Vec<Option<ObjectId>> = vec![None; slots];
    for joint in &trace.steps {
        for (actor, part) in actors.iter_mut().zip(&joint.parts) {
            if let Some(part) = part {
                let first = *part.arguments.first()?;
                if *actor.get_or_insert(first) != first {
                    return None;
                }
            }
        }
    }
    let actors: Vec<ObjectId> = actors.into_iter().collect::<Option<_>>()?;
    let alone = |at: usize| !actors[..at].contains(&actors[at]);
    (0..actors.len()).all(alone).then_some(actors)
}
