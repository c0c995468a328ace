//! What a hand does goes in, as three features; its activity comes out, by a decision tree that a person can read.

use std::fmt::{self, Write as _};

use petgraph::graph::{DiGraph, NodeIndex};

use crate::log::HandState;
use crate::truth::Activity;

/// A feature of table 3.1, as yes or no.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// The hand moves.
    HandMove,
    /// It acts on something.
    ActedOn,
    /// It holds something.
    InHand,
}

impl Feature {
    /// All of them, in the order of table 3.1.
    pub const ALL: [Feature; 3] = [Feature::HandMove, Feature::ActedOn, Feature::InHand];

    /// Whether a hand has it.
    pub fn holds(self, state: &HandState) -> bool {
        match self {
            Feature::HandMove => state.moves,
            Feature::ActedOn => state.acted_on.is_some(),
            Feature::InHand => state.in_hand.is_some(),
        }
    }

    /// The question that it answers, and both answers as table 3.1 has them.
    fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Feature::HandMove => ("handMove", "true", "false"),
            Feature::ActedOn => ("actedOn", "an object", "nil"),
            Feature::InHand => ("inHand", "an object", "nil"),
        }
    }
}

/// A decision tree from [`Feature`]s to [`Activity`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Tree {
    /// No more questions.
    Leaf {
        /// The activity.
        activity: Activity,
        /// How many annotated frames came here, in the order of [`Activity::ALL`]; all 0 in a tree that was not learned.
        counts: [u64; 5],
    },
    /// One question.
    Node {
        /// What is asked.
        feature: Feature,
        /// How it goes on if the hand has the feature.
        yes: Box<Tree>,
        /// How it goes on if not.
        no: Box<Tree>,
    },
}

impl Tree {
    /// Table 3.1 of the thesis, made total.
    ///
    /// The table leaves out two of the eight combinations, both with a hand that rests while it acts on something.
    /// In the published program that cannot be, since `actedOn` is only looked for while a hand moves; a log that gives the features itself may say so.
    /// A hand that pauses on its way has not changed its aim: with nothing in it, it goes on with Reach, and with something in it with Granular.
    pub fn published() -> Self {
        let leaf = |activity| Box::new(Tree::Leaf { activity, counts: [0; 5] });
        let ask = |feature, yes, no| Box::new(Tree::Node { feature, yes, no });
        let held = ask(
            Feature::ActedOn,
            leaf(Activity::Granular),
            ask(Feature::HandMove, leaf(Activity::Put), leaf(Activity::Take)),
        );
        let empty = ask(Feature::ActedOn, leaf(Activity::Reach), leaf(Activity::Idle));
        *ask(Feature::InHand, held, empty)
    }

    /// The activity of a hand.
    pub fn classify(&self, state: &HandState) -> Activity {
        let mut tree = self;
        loop {
            match tree {
                Tree::Leaf { activity, .. } => return *activity,
                Tree::Node { feature, yes, no } => {
                    tree = if feature.holds(state) { yes } else { no };
                }
            }
        }
    }

    /// The tree as a graph: nodes are questions and activities, edges are answers; the root comes first.
    pub fn graph(&self) -> DiGraph<String, &'static str> {
        let mut graph = DiGraph::new();
        self.grow(&mut graph);
        graph
    }

    fn grow(&self, graph: &mut DiGraph<String, &'static str>) -> NodeIndex {
        match self {
            Tree::Leaf { activity, counts } => {
                let label = match counts.iter().sum::<u64>() {
                    0 => activity.to_string(),
                    all => format!("{activity}\n{} of {all}", counts[activity.index()]),
                };
                graph.add_node(label)
            }
            Tree::Node { feature, yes, no } => {
                let (question, so, not_so) = feature.words();
                let node = graph.add_node(question.to_string());
                for (branch, answer) in [(yes, so), (no, not_so)] {
                    let child = branch.grow(graph);
                    graph.add_edge(node, child, answer);
                }
                node
            }
        }
    }

    /// The graph in the language of Graphviz.
    pub fn dot(&self) -> String {
        let graph = self.graph();
        let mut text = String::from("digraph activities {\n  node [fontname=\"sans-serif\"];\n");
        for node in graph.node_indices() {
            let shape = if graph.neighbors(node).next().is_some() { "ellipse" } else { "box" };
            let label = graph[node].replace('\n', "\\n");
            let _ = writeln!(text, "  n{} [label=\"{label}\", shape={shape}];", node.index());
        }
        for edge in graph.edge_indices() {
            let (from, to) = graph.edge_endpoints(edge).expect("the edge is in the graph");
            let _ = writeln!(
                text,
                "  n{} -> n{} [label=\"{}\"];",
                from.index(),
                to.index(),
                graph[edge]
            );
        }
        text + "}\n"
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, depth: usize) -> fmt::Result {
        match self {
            Tree::Leaf { activity, counts } => {
                write!(f, ": {activity}")?;
                let all: u64 = counts.iter().sum();
                if all > 0 {
                    write!(f, " ({all} frames")?;
                    let wrong = all - counts[activity.index()];
                    if wrong > 0 {
                        write!(f, ", {wrong} of them something else")?;
                    }
                    write!(f, ")")?;
                }
                writeln!(f)
            }
            Tree::Node { feature, yes, no } => {
                if depth > 0 {
                    writeln!(f)?;
                }
                let (question, so, not_so) = feature.words();
                for (branch, answer) in [(yes, so), (no, not_so)] {
                    write!(f, "{:indent$}{question} = {answer}", "", indent = depth * 4)?;
                    branch.write(f, depth + 1)?;
                }
                Ok(())
            }
        }
    }
}

/// One line for each answer, indented below the question before it.
impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Tree::Leaf { activity, .. } => writeln!(f, "always {activity}"),
            Tree::Node { .. } => self.write(f, 0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::ObjectId;

    fn state(moves: bool, acted_on: bool, in_hand: bool) -> HandState {
        let some = |yes: bool, id| yes.then_some(ObjectId(id));
        HandState { moves, acted_on: some(acted_on, 0), in_hand: some(in_hand, 1) }
    }

    #[test]
    fn the_default_tree_is_table_3_1_and_total() {
        let tree = Tree::published();
        let table = [
            (true, true, true, Activity::Granular),
            (true, false, false, Activity::Idle),
            (false, false, false, Activity::Idle),
            (true, true, false, Activity::Reach),
            (true, false, true, Activity::Put),
            (false, false, true, Activity::Take),
            // What the table leaves out.
            (false, true, false, Activity::Reach),
            (false, true, true, Activity::Granular),
        ];
        for (moves, acted_on, in_hand, activity) in table {
            assert_eq!(tree.classify(&state(moves, acted_on, in_hand)), activity);
        }
    }

    #[test]
    fn a_tree_reads_as_questions_and_answers() {
        insta::assert_snapshot!(Tree::published(), @r"
        inHand = an object
            actedOn = an object: Granular
            actedOn = nil
                handMove = true: Put
                handMove = false: Take
        inHand = nil
            actedOn = an object: Reach
            actedOn = nil: Idle
        ");
    }

    #[test]
    fn a_tree_is_a_graph() {
        let graph = Tree::published().graph();
        assert_eq!((graph.node_count(), graph.edge_count()), (9, 8));
        let dot = Tree::published().dot();
        assert!(dot.starts_with("digraph activities {\n"), "{dot}");
        assert!(dot.contains("n0 [label=\"inHand\", shape=ellipse];"), "{dot}");
        assert!(dot.contains("n2 [label=\"Granular\", shape=box];"), "{dot}");
        assert!(dot.contains("n0 -> n1 [label=\"an object\"];"), "{dot}");
    }
}
