//! The text of a domain and a problem goes in; a [`World`] in which every variable is replaced by every object comes out.

use std::collections::{BTreeMap, BTreeSet};

use super::naive::{Action, Effect, Formula, Outcome, World};
use super::text::{Tree, Typed, fields, typed};

type Binding = BTreeMap<String, String>;

/// What the names of a domain and a problem mean.
struct Names {
    /// The types directly above each type and each object.
    above: BTreeMap<String, Vec<String>>,
    objects: Vec<String>,
    actions: BTreeSet<String>,
    /// The value of `(length a b)`.
    values: BTreeMap<String, i64>,
    /// `(total-cost)`, if it is to be minimised.
    metric: Option<String>,
}

/// Reads a domain and a problem without mistakes. The rules of a derived predicate stand behind those that they depend on.
pub fn world(domain: &str, problem: &str) -> World {
    let (domain, problem) = (Tree::read(domain), Tree::read(problem));
    let sections = |keyword: &'static str| {
        domain.tail().iter().chain(problem.tail()).filter(move |section| section.head() == keyword)
    };
    let schemas: Vec<&Tree> = sections(":action").collect();
    let mut names = Names {
        above: BTreeMap::new(),
        objects: Vec::new(),
        actions: schemas.iter().map(|schema| schema.tail()[0].word().to_owned()).collect(),
        values: BTreeMap::new(),
        metric: sections(":metric").next_back().map(|metric| {
            ground(metric.tail().last().expect("a metric is not empty"), &Binding::new())
        }),
    };
    names.above.extend(sections(":types").flat_map(|types| typed(types.tail())));
    for list in sections(":constants").chain(sections(":objects")) {
        let (private, public): (Vec<_>, Vec<_>) =
            list.tail().iter().cloned().partition(|tree| tree.head() == ":private");
        // Behind `:private` stands the agent, and then what belongs to it.
        let lists = private.iter().map(|private| &private.tail()[1..]).chain([public.as_slice()]);
        for (object, types) in lists.flat_map(typed) {
            names.objects.push(object.clone());
            names.above.insert(object, types);
        }
    }
    let mut initial = BTreeSet::new();
    for fact in sections(":init").flat_map(Tree::tail) {
        if fact.head() == "=" {
            let value = fact.tail()[1].word().parse().expect("values are integers");
            names.values.insert(ground(&fact.tail()[0], &Binding::new()), value);
        } else {
            initial.insert(ground(fact, &Binding::new()));
        }
    }
    World {
        initial,
        actions: schemas.iter().flat_map(|schema| names.instances(schema)).collect(),
        axioms: names.axioms(sections(":derived")),
        goal: Formula::All(sections(":goal").map(|goal| names.goal(goal)).collect()),
        counts_cost: names.metric.is_some(),
        safe: is_safe(&domain, &names),
    }
}

/// Whether the domain speaks of privacy and not of joint actions.
fn is_safe(domain: &Tree, names: &Names) -> bool {
    fn mentions(tree: &Tree, head: &dyn Fn(&str) -> bool) -> bool {
        head(tree.head()) || tree.list().iter().any(|tree| mentions(tree, head))
    }
    let requirements: Vec<&str> = domain
        .tail()
        .iter()
        .filter(|section| section.head() == ":requirements")
        .flat_map(|section| section.tail().iter().map(Tree::word))
        .collect();
    let predicates = domain.tail().iter().filter(|section| section.head() == ":predicates");
    let private = requirements.iter().any(|flag| flag.ends_with("-privacy"))
        || predicates.flat_map(Tree::tail).any(|tree| tree.head() == ":private");
    let asks = domain
        .tail()
        .iter()
        .filter(|section| section.head() == ":action")
        .any(|schema| mentions(schema, &|head| names.actions.contains(head)));
    private && !asks
}

/// `(on a b)`.
fn ground(atom: &Tree, binding: &Binding) -> String {
    let words: Vec<&str> = atom.list().iter().map(|word| term(word, binding)).collect();
    format!("({})", words.join(" "))
}

fn term<'a>(term: &'a Tree, binding: &'a Binding) -> &'a str {
    binding.get(term.word()).map_or(term.word(), String::as_str)
}

impl Names {
    /// Whether an object is of a type; an object is also a type, of which it is the only one.
    fn is(&self, name: &str, wanted: &str) -> bool {
        let above = self.above.get(name).map_or(&[][..], Vec::as_slice);
        name == wanted || wanted == "object" || above.iter().any(|above| self.is(above, wanted))
    }

    /// `outer` with all objects of the right types for the variables.
    fn bindings(&self, variables: &Typed, outer: &Binding) -> Vec<Binding> {
        let mut bindings = vec![outer.clone()];
        for (variable, types) in variables {
            let mut longer = Vec::new();
            for binding in bindings {
                for object in &self.objects {
                    if types.iter().any(|wanted| self.is(object, wanted)) {
                        let mut binding = binding.clone();
                        binding.insert(variable.clone(), object.clone());
                        longer.push(binding);
                    }
                }
            }
            bindings = longer;
        }
        bindings
    }

    fn formula(&self, tree: &Tree, binding: &Binding) -> Formula {
        let tail = tree.tail();
        let below = |at: usize| self.formula(&tail[at], binding);
        let all = || (0..tail.len()).map(below).collect::<Vec<_>>();
        let not = |at: usize| Formula::Not(Box::new(below(at)));
        match tree.head() {
            "" | "and" => Formula::All(all()),
            "or" => Formula::Any(all()),
            "not" => not(0),
            "imply" => Formula::Any(vec![not(0), below(1)]),
            "=" if term(&tail[0], binding) == term(&tail[1], binding) => Formula::All(Vec::new()),
            "=" => Formula::Any(Vec::new()),
            quantifier @ ("forall" | "exists") => {
                let bindings = self.bindings(&typed(tail[0].list()), binding);
                let parts = bindings.iter().map(|binding| self.formula(&tail[1], binding));
                let parts = parts.collect();
                if quantifier == "forall" { Formula::All(parts) } else { Formula::Any(parts) }
            }
            action if self.actions.contains(action) => Formula::Acts(ground(tree, binding)),
            _ => Formula::Fact(ground(tree, binding)),
        }
    }

    /// Every ground action of a schema, by its line.
    fn instances(&self, schema: &Tree) -> Vec<(String, Action)> {
        let name = schema.tail()[0].word();
        let fields = fields(&schema.tail()[1..]);
        let agent = fields.get(":agent").map(|agent| acting(agent));
        let mut parameters: Typed = agent.iter().flatten().cloned().collect();
        parameters.extend(
            fields.get(":parameters").map(|list| typed(list[0].list())).into_iter().flatten(),
        );
        let tree = |keyword: &str| {
            fields.get(keyword).map_or(Tree::List(Vec::new()), |field| field[0].clone())
        };
        let (precondition, effect) = (tree(":precondition"), tree(":effect"));
        let mut instances = Vec::new();
        for binding in self.bindings(&parameters, &Binding::new()) {
            let arguments: Vec<&str> =
                parameters.iter().map(|(variable, _)| binding[variable].as_str()).collect();
            let words: Vec<&str> = [name].into_iter().chain(arguments.iter().copied()).collect();
            let mut effects = Vec::new();
            self.effects(&effect, &binding, &mut Vec::new(), &mut effects);
            let action = Action {
                agent: agent.as_ref().map(|_| arguments[0].to_owned()),
                precondition: self.formula(&precondition, &binding),
                effects,
            };
            instances.push((format!("({})", words.join(" ")), action));
        }
        instances
    }

    /// Takes an effect apart; `conditions` are those that it stands under.
    fn effects(
        &self,
        tree: &Tree,
        binding: &Binding,
        conditions: &mut Vec<Formula>,
        effects: &mut Vec<Effect>,
    ) {
        let tail = tree.tail();
        let outcome = match tree.head() {
            "" | "and" => {
                return tail
                    .iter()
                    .for_each(|tree| self.effects(tree, binding, conditions, effects));
            }
            "forall" => {
                for binding in self.bindings(&typed(tail[0].list()), binding) {
                    self.effects(&tail[1], &binding, conditions, effects);
                }
                return;
            }
            "when" => {
                conditions.push(self.formula(&tail[0], binding));
                self.effects(&tail[1], binding, conditions, effects);
                conditions.pop();
                return;
            }
            "increase" if self.metric != Some(ground(&tail[0], binding)) => return,
            "increase" => Outcome::Cost(match &tail[1] {
                Tree::Word(number) => number.parse().expect("costs are integers"),
                function @ Tree::List(_) => self.values[&ground(function, binding)],
            }),
            "not" => Outcome::Delete(ground(&tail[0], binding)),
            _ => Outcome::Add(ground(tree, binding)),
        };
        effects.push(Effect { condition: Formula::All(conditions.clone()), outcome });
    }

    /// The rules of each derived predicate, in the order in which each has its first.
    fn axioms<'a>(&self, rules: impl Iterator<Item = &'a Tree>) -> Vec<Vec<(String, Formula)>> {
        let mut heads: Vec<&str> = Vec::new();
        let mut axioms: Vec<Vec<(String, Formula)>> = Vec::new();
        for rule in rules {
            let (head, body) = (&rule.tail()[0], &rule.tail()[1]);
            let at = heads.iter().position(|known| *known == head.head()).unwrap_or_else(|| {
                heads.push(head.head());
                axioms.push(Vec::new());
                heads.len() - 1
            });
            let parameters = typed(head.tail());
            for binding in self.bindings(&parameters, &Binding::new()) {
                let words: Vec<&str> = [head.head()]
                    .into_iter()
                    .chain(parameters.iter().map(|(variable, _)| binding[variable].as_str()))
                    .collect();
                let fact = format!("({})", words.join(" "));
                axioms[at].push((fact, self.formula(body, &binding)));
            }
        }
        axioms
    }

    /// `(:goal F)`, or of an agent; what is demanded of any is demanded of all.
    fn goal(&self, goal: &Tree) -> Formula {
        let fields = fields(goal.tail());
        let Some(condition) = fields.get(":condition") else {
            return self.formula(&goal.tail()[0], &Binding::new());
        };
        let agents: Typed =
            fields.get(":agent").map(|agent| acting(agent)).into_iter().flatten().collect();
        let bindings = self.bindings(&agents, &Binding::new());
        Formula::All(bindings.iter().map(|binding| self.formula(&condition[0], binding)).collect())
    }
}

/// Who acts, as the variable that is bound: `?a - t`, `?a`, a type or an object.
fn acting(agent: &[Tree]) -> Typed {
    match agent {
        [Tree::List(list)] => typed(list),
        [name] if !name.word().starts_with('?') => {
            vec![(":agent".to_owned(), vec![name.word().to_owned()])]
        }
        list => typed(list),
    }
}
