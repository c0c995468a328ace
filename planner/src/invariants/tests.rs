//! Classic domains and the groups that they have, and groups against all reachable states.

use std::fmt::Write;

use lang::model::{
    ActionId, Domain, Fact, Formula, Name, Object, ObjectId, PredicateId, Problem, Scope, Type,
    TypeId,
};
use lang::source::{SourceId, Span};

use super::*;
use crate::encode::tests::semantics::Propositional;
use crate::ground::{Outcome, ground};
use crate::normal::{Atom, Condition, Effect, Filter, Literal, Predicate, Schema, Term, Variable};

/// A problem in a short notation, a line for each action and one for the initial state:
/// `move(x a b): at(x,a) road(a,b) a!=b -> -at(x,a) at(x,b) | y: in(y,x) -> -at(y,a) at(y,b)`, `init: at(t,l1)`, `goal: at(t,l2)`.
/// What stands behind a bar is for all bindings of the variables before the colon. Every name that is no variable is an object.
struct Sketch {
    predicates: Vec<Predicate>,
    objects: Vec<String>,
    normal: Normal,
    init: Vec<Fact>,
}

fn name(text: &str) -> Name {
    Name { text: text.to_owned(), span: Span { source: SourceId(0), start: 0, end: 0 } }
}

impl Sketch {
    fn parse(text: &str) -> Self {
        let mut sketch = Self {
            predicates: Vec::new(),
            objects: Vec::new(),
            init: Vec::new(),
            normal: Normal {
                predicates: Vec::new(),
                schemas: Vec::new(),
                rules: Vec::new(),
                goal: Condition::default(),
                goal_variables: Vec::new(),
                scale: 0,
                uses_metric: false,
            },
        };
        for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
            let (head, body) = line.split_once(": ").expect("a line has a colon");
            match head {
                "init" => {
                    let atoms = sketch.condition(body, &[]).literals;
                    sketch.init =
                        atoms.into_iter().map(|literal| ground_fact(&literal.atom)).collect();
                }
                "goal" => sketch.normal.goal = sketch.condition(body, &[]),
                _ => sketch.schema(head, body),
            }
        }
        sketch.normal.predicates.clone_from(&sketch.predicates);
        sketch
    }

    fn schema(&mut self, head: &str, body: &str) {
        let (_, parameters) =
            head.trim_end_matches(')').split_once('(').expect("an action has parameters");
        let mut names: Vec<&str> = parameters.split_whitespace().collect();
        let parameters = names.len();
        let mut groups = body.split(" | ");
        let (before, after) = groups
            .next()
            .expect("a split has a first part")
            .split_once("->")
            .expect("an action has an arrow");
        let condition = self.condition(before, &names);
        let mut effects = Vec::new();
        self.effects(after, &names, &[], &Condition::default(), &mut effects);
        for group in groups {
            let (variables, rest) = group.split_once(": ").expect("a group has variables");
            let first = names.len() as u32;
            names.extend(variables.split_whitespace());
            let variables: Vec<u32> = (first..names.len() as u32).collect();
            let (before, after) = rest.split_once("->").expect("a group has an arrow");
            let condition = self.condition(before, &names);
            self.effects(after, &names, &variables, &condition, &mut effects);
        }
        self.normal.schemas.push(Schema {
            action: ActionId(self.normal.schemas.len() as u32),
            variables: names
                .iter()
                .map(|name| Variable { name: (*name).to_owned(), types: vec![TypeId(0)] })
                .collect(),
            parameters,
            bound: parameters,
            condition,
            effects,
            costs: Vec::new(),
        });
    }

    fn effects(
        &mut self,
        text: &str,
        names: &[&str],
        variables: &[u32],
        condition: &Condition,
        out: &mut Vec<Effect>,
    ) {
        for literal in self.condition(text, names).literals {
            self.predicates[literal.atom.predicate.index()].kind = Kind::Fluent;
            out.push(Effect {
                variables: variables.to_vec(),
                condition: condition.clone(),
                literal,
            });
        }
    }

    fn condition(&mut self, text: &str, names: &[&str]) -> Condition {
        let mut condition = Condition::default();
        for word in text.split_whitespace() {
            if let Some((left, right)) = word.split_once("!=") {
                let equal = Filter::Equal(self.term(left, names), self.term(right, names));
                condition.filters.push(Filter::Not(Box::new(equal)));
                continue;
            }
            let (word, positive) =
                word.strip_prefix('-').map_or((word, true), |word| (word, false));
            let (head, arguments) =
                word.trim_end_matches(')').split_once('(').unwrap_or((word, ""));
            let arguments: Vec<Term> = arguments
                .split(',')
                .filter(|term| !term.is_empty())
                .map(|term| self.term(term, names))
                .collect();
            let known = self.predicates.iter().position(|predicate| predicate.name == head);
            let predicate = known.unwrap_or_else(|| {
                self.predicates.push(Predicate {
                    name: head.to_owned(),
                    arity: arguments.len(),
                    kind: Kind::Static,
                });
                self.predicates.len() - 1
            });
            condition.literals.push(Literal {
                positive,
                atom: Atom { predicate: PredicateId(predicate as u32), arguments },
            });
        }
        condition
    }

    fn term(&mut self, text: &str, names: &[&str]) -> Term {
        if let Some(variable) = names.iter().position(|name| *name == text) {
            return Term::Variable(variable as u32);
        }
        let object = self.objects.iter().position(|object| object == text).unwrap_or_else(|| {
            self.objects.push(text.to_owned());
            self.objects.len() - 1
        });
        Term::Object(ObjectId(object as u32))
    }

    fn model(&self) -> (Domain, Problem) {
        let domain = Domain {
            types: vec![Type {
                name: name("object"),
                parents: Vec::new(),
                ancestors: vec![TypeId(0)],
            }],
            ..Domain::new(name("sketch"))
        };
        let problem = Problem {
            name: name("sketch"),
            objects: self
                .objects
                .iter()
                .map(|text| Object { name: name(text), types: vec![TypeId(0)], holder: None })
                .collect(),
            init: self.init.clone(),
            values: Vec::new(),
            goal_scope: Scope::default(),
            goal: Formula::truth(name("").span),
            metric: None,
            uses: Vec::new(),
        };
        (domain, problem)
    }
}

fn ground_fact(atom: &Atom) -> Fact {
    let object = |term: &Term| match term {
        Term::Object(object) => *object,
        Term::Variable(_) => panic!("an initial fact has no variables"),
    };
    Fact { predicate: atom.predicate, arguments: atom.arguments.iter().map(object).collect() }
}

/// The groups by name, after a check that they hold in every reachable state.
fn found(text: &str) -> String {
    let sketch = Sketch::parse(text);
    let (domain, problem) = sketch.model();
    let Ok(Outcome::Grounded(grounded)) =
        ground(&domain, &problem, &sketch.normal, &Limits::default())
    else {
        panic!("the goal of a sketch can be reached");
    };
    let groups = groups(&domain, &problem, &sketch.normal, &grounded, &Limits::default());
    let states = Propositional::explore(&grounded).states;
    let mut out = String::new();
    for group in &groups {
        let most = states
            .iter()
            .map(|state| group.iter().filter(|fact| state >> fact.0 & 1 == 1).count())
            .max();
        let mut names: Vec<String> =
            group.iter().map(|fact| spell(&sketch, &grounded, *fact)).collect();
        names.sort_unstable();
        assert_eq!(most, Some(1), "{names:?}");
        writeln!(out, "{}", names.join(" ")).expect("a string takes all");
    }
    out
}

fn spell(sketch: &Sketch, grounded: &Grounded, fact: FactId) -> String {
    let fact = &grounded.facts[fact.index()];
    let arguments = &grounded.arguments[fact.arguments.start as usize..fact.arguments.end as usize];
    let arguments: Vec<&str> =
        arguments.iter().map(|object| sketch.objects[object.index()].as_str()).collect();
    let predicate = &sketch.predicates[fact.predicate.index()].name;
    if arguments.is_empty() {
        predicate.clone()
    } else {
        format!("{predicate}({})", arguments.join(","))
    }
}

#[test]
fn a_block_is_somewhere_and_has_something_on_it_and_the_hand_holds_one() {
    insta::assert_snapshot!(found("
        pick-up(x): clear(x) ontable(x) handempty -> -ontable(x) -clear(x) -handempty holding(x)
        put-down(x): holding(x) -> -holding(x) clear(x) handempty ontable(x)
        stack(x y): holding(x) clear(y) -> -holding(x) -clear(y) clear(x) handempty on(x,y)
        unstack(x y): on(x,y) clear(x) handempty -> holding(x) clear(y) -clear(x) -handempty -on(x,y)
        init: clear(a) ontable(b) on(a,b) handempty ontable(c) clear(c)
        goal: on(b,a)
    "), @r"
    handempty holding(a) holding(b) holding(c)
    clear(a) holding(a) on(a,a) on(b,a) on(c,a)
    clear(c) holding(c) on(a,c) on(b,c) on(c,c)
    clear(b) holding(b) on(a,b) on(b,b) on(c,b)
    holding(b) on(b,a) on(b,b) on(b,c) ontable(b)
    holding(c) on(c,a) on(c,b) on(c,c) ontable(c)
    holding(a) on(a,a) on(a,b) on(a,c) ontable(a)
    ");
}

#[test]
fn a_package_is_in_one_place_or_vehicle() {
    insta::assert_snapshot!(found("
        load(p t l): package(p) truck(t) at(t,l) at(p,l) -> -at(p,l) in(p,t)
        unload(p t l): truck(t) at(t,l) in(p,t) -> -in(p,t) at(p,l)
        drive(t a b): truck(t) at(t,a) road(a,b) -> -at(t,a) at(t,b)
        init: truck(t) package(p) package(q) at(t,l) at(p,l) at(q,m) road(l,m) road(m,l)
        goal: at(p,m)
    "), @r"
    at(t,l) at(t,m)
    at(p,l) at(p,m) in(p,t)
    at(q,l) at(q,m) in(q,t)
    ");
}

#[test]
fn a_gripper_is_free_or_carries_one_ball() {
    insta::assert_snapshot!(found("
        move(a b): room(a) room(b) robby(a) a!=b -> -robby(a) robby(b)
        pick(o r g): ball(o) room(r) gripper(g) at(o,r) robby(r) free(g) -> carry(o,g) -at(o,r) -free(g)
        drop(o r g): ball(o) room(r) gripper(g) carry(o,g) robby(r) -> at(o,r) free(g) -carry(o,g)
        init: room(ra) room(rb) ball(b1) ball(b2) gripper(left) gripper(right) robby(ra) free(left) free(right) at(b1,ra) at(b2,ra)
        goal: at(b1,rb)
    "), @r"
    robby(ra) robby(rb)
    at(b1,ra) at(b1,rb) carry(b1,left) carry(b1,right)
    at(b2,ra) at(b2,rb) carry(b2,left) carry(b2,right)
    carry(b1,left) carry(b2,left) free(left)
    carry(b1,right) carry(b2,right) free(right)
    ");
}

#[test]
fn a_cell_of_sokoban_is_clear_or_has_a_stone_or_the_player() {
    insta::assert_snapshot!(found("
        move(a b): player(a) clear(b) next(a,b) -> -player(a) player(b) clear(a) -clear(b)
        push(s a b c): player(a) stone(s,b) clear(c) line(a,b,c) -> -player(a) player(b) -stone(s,b) stone(s,c) clear(a) -clear(c)
        init: player(x1) stone(s,x2) clear(x3) clear(x4) next(x1,x2) next(x2,x1) next(x2,x3) next(x3,x2) next(x3,x4) line(x1,x2,x3) line(x2,x3,x4)
        goal: stone(s,x4)
    "), @r"
    player(x1) player(x2) player(x3) player(x4)
    stone(s,x2) stone(s,x3) stone(s,x4)
    clear(x1) player(x1)
    clear(x3) player(x3) stone(s,x3)
    clear(x4) player(x4) stone(s,x4)
    clear(x2) player(x2) stone(s,x2)
    ");
}

#[test]
fn a_conditional_effect_for_all_is_balanced_by_a_delete_under_the_same_condition() {
    insta::assert_snapshot!(found("
        drive(a b): bus(a) road(a,b) -> -bus(a) bus(b) | x: aboard(x) at(x,a) -> -at(x,a) at(x,b)
        board(x a): bus(a) at(x,a) -> aboard(x)
        init: bus(l) road(l,m) road(m,l) at(p,l) at(q,l)
        goal: at(p,m)
    "), @r"
    bus(l) bus(m)
    at(p,l) at(p,m)
    at(q,l) at(q,m)
    ");
}

#[test]
fn an_effect_for_all_that_adds_several_is_no_invariant_over_what_it_binds() {
    insta::assert_snapshot!(found("
        flash(a): dark(a) -> -dark(a) | x: lamp(x) -> lit(x,a)
        init: dark(r) lamp(x) lamp(y)
        goal: lit(x,r) lit(y,r)
    "), @"");
}

#[test]
fn what_is_deleted_and_added_again_balances_nothing() {
    insta::assert_snapshot!(found("
        copy(a b): at(a) spot(b) a!=b -> -at(a) at(a) at(b)
        init: at(l) spot(l) spot(m)
        goal: at(m)
    "), @"");
}

#[test]
fn one_object_for_two_parameters_is_told_apart_by_the_ground_operators() {
    insta::assert_snapshot!(found("
        swap(x y a b): at(x,a) at(y,b) pair(x,y) -> -at(x,a) -at(y,b) at(x,b) at(y,a)
        init: pair(k,l) at(k,p) at(l,q)
        goal: at(k,q)
    "), @r"
    at(k,p) at(l,p)
    at(k,q) at(l,q)
    at(k,p) at(k,q)
    at(l,p) at(l,q)
    ");
}
