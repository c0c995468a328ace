//! Parentheses and words go in, one by one; how much of it is not as a person writes comes out as a [`Cost`].
//!
//! A cost has two parts. The first counts what cannot be: a parenthesis without its partner, a field outside of its action.
//! The second counts what is odd: a list among the arguments of a predicate, a second formula after `not`, a line that is not in line with those before it.
//! Of two ways to repair a text the one with the lower cost is right, mostly.

use super::word::{Kind, Role, Word};

/// A parenthesis or a word.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) kind: PieceKind,
    /// The token that it is, or after which it was inserted.
    pub(super) token: u32,
    /// How far it is indented, if it is the first of its line.
    pub(super) indent: Option<u32>,
}

/// What a [`Piece`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PieceKind {
    Open,
    Close,
    Word(Word),
}

/// How much is wrong; compared part by part.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Cost {
    /// What cannot be.
    pub(super) impossible: u32,
    /// What is odd.
    pub(super) odd: u32,
}

/// What a keyword in a wrong place costs. It is more than a parenthesis, so that one may be inserted for it that is taken away elsewhere.
const MISPLACED: u32 = 3;

/// What a word or a list in a wrong place costs, measured in lines that are indented oddly.
pub(super) const UNEXPECTED: u32 = 6;

/// The last thing in a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Last {
    /// Nothing after the first word.
    Nothing,
    Word,
    Dash,
    /// What follows a dash.
    Type,
    List,
    /// The keyword of a field, whose value is to follow.
    Field(Role),
}

/// An open list.
#[derive(Debug, Clone, Copy)]
struct Frame {
    kind: Kind,
    /// How many words and lists there are after its first word.
    given: u32,
    last: Last,
    /// The line on which it opens, and how far that is indented.
    line: u32,
    indent: u32,
    /// How far the last line is indented that starts with something directly in it.
    inside: Option<u32>,
}

/// What has been read so far.
#[derive(Debug, Clone)]
pub(super) struct State {
    stack: Vec<Frame>,
    /// How many lists are to be open at the end.
    floor: usize,
    pub(super) cost: Cost,
    /// Whether a whole list has ended outside of all others.
    ended: bool,
    line: u32,
    indent: u32,
}

impl State {
    /// Before the definition, or directly in it; `floor` lists stay open to the end.
    pub(super) fn new(depth: u32, floor: usize) -> Self {
        let definition = Frame {
            kind: Kind::Definition,
            given: 1,
            last: Last::List,
            line: 0,
            indent: 0,
            inside: None,
        };
        Self {
            stack: vec![definition; depth as usize],
            floor,
            cost: Cost::default(),
            ended: false,
            line: 0,
            indent: 0,
        }
    }

    /// How many lists are open.
    pub(super) fn depth(&self) -> usize {
        self.stack.len()
    }

    /// Whether words are wanted here: a list that is opened for them would hide whatever follows.
    pub(super) fn is_in_words(&self) -> bool {
        let list = self.stack.last();
        list.is_some_and(|list| list.kind == Kind::Fields && list.last == Last::Field(Role::Words))
    }

    /// Reads one more.
    pub(super) fn step(&mut self, piece: Piece) {
        if let Some(indent) = piece.indent {
            self.start_line(indent, piece.kind == PieceKind::Close);
        }
        match piece.kind {
            PieceKind::Open => self.open(),
            PieceKind::Close => self.close(),
            PieceKind::Word(word) => self.word(word),
        }
    }

    /// The cost if the section ends here.
    pub(super) fn finish(mut self) -> Cost {
        self.cost.impossible += self.stack.len().abs_diff(self.floor) as u32;
        while self.stack.len() > self.floor {
            self.close();
        }
        self.cost
    }

    /// The cost if the whole text ends here, and so many lists with it.
    ///
    /// It may have been cut off, so no list is blamed for what is not in it.
    pub(super) fn cut(mut self, closed: usize) -> Cost {
        let open = self.stack.len().saturating_sub(closed);
        self.cost.impossible += open.abs_diff(self.floor) as u32;
        self.cost
    }

    fn start_line(&mut self, indent: u32, closes: bool) {
        self.line += 1;
        self.indent = indent;
        let Some(list) = self.stack.last_mut().filter(|list| list.line < self.line) else {
            return;
        };
        if closes {
            // It stands below the start of its list, or else below what is in it.
            let below = Some(indent) == list.inside;
            self.cost.odd += u32::from(indent != list.indent) * if below { 1 } else { 2 };
            self.cost.odd += 2 * u32::from(indent < list.indent);
            // What fits on a line needs none of its own for its end.
            self.cost.odd += 2 * u32::from(list.inside.is_none());
            return;
        }
        let sibling = list.inside.replace(indent);
        if sibling == Some(indent) {
            return;
        }
        self.cost.odd += u32::from(sibling.is_some());
        if list.kind != Kind::Definition {
            self.cost.odd += u32::from(indent <= list.indent) + u32::from(indent < list.indent);
        }
    }

    fn open(&mut self) {
        let (role, odd) = match self.stack.last_mut() {
            Some(list) => list.list(),
            None => (Role::Top, self.ended),
        };
        self.cost.odd += UNEXPECTED * u32::from(odd);
        self.stack.push(Frame {
            kind: Kind::New(role),
            given: 0,
            last: Last::Nothing,
            line: self.line,
            indent: self.indent,
            inside: None,
        });
    }

    fn close(&mut self) {
        let Some(list) = self.stack.pop() else {
            self.cost.impossible += 1;
            return;
        };
        self.cost.odd += UNEXPECTED * u32::from(list.is_unfinished());
        self.ended |= self.stack.is_empty();
        self.cost.impossible += u32::from(self.stack.len() < self.floor);
    }

    fn word(&mut self, word: Word) {
        let keyword = matches!(word, Word::Keyword(..));
        let odd = match self.stack.last_mut() {
            Some(list) if keyword && !list.takes_keyword() => {
                self.cost.impossible += MISPLACED;
                false
            }
            Some(list) => list.word(word),
            None => {
                self.cost.impossible += MISPLACED * u32::from(keyword);
                !keyword
            }
        };
        self.cost.odd += UNEXPECTED * u32::from(odd);
    }
}

impl Frame {
    /// Whether a word with a colon may stand here.
    fn takes_keyword(self) -> bool {
        match self.kind {
            Kind::New(role) => {
                matches!(role, Role::Section | Role::Declaration | Role::Part | Role::Free)
            }
            Kind::Fields | Kind::Free | Kind::Names { keywords: true } => true,
            _ => false,
        }
    }

    /// Takes a list in: what it is for, and whether it is odd that there is one.
    fn list(&mut self) -> (Role, bool) {
        let given = self.given;
        self.given += 1;
        let last = std::mem::replace(&mut self.last, Last::List);
        match self.kind {
            Kind::New(role) => {
                self.kind = match role {
                    Role::Variables => Kind::Variables,
                    Role::Formula => Kind::Loose,
                    _ => Kind::Free,
                };
                if role == Role::Variables { (Role::Type, false) } else { (role, true) }
            }
            Kind::Definition if given == 0 => (Role::Title, false),
            Kind::Definition => (Role::Section, false),
            Kind::Fields => match last {
                Last::Field(role) => (role, false),
                _ => (Role::Formula, true),
            },
            Kind::Declarations | Kind::Private => (Role::Declaration, false),
            Kind::Names { .. } => (Role::Part, false),
            Kind::Variables => (Role::Type, last != Last::Dash),
            Kind::Facts => (Role::Fact, false),
            Kind::Loose => (Role::Formula, false),
            Kind::Formulas { most, .. } => (Role::Formula, given >= most),
            Kind::Derived if given == 0 => (Role::Declaration, false),
            Kind::Quantifier if given == 0 => (Role::Variables, false),
            Kind::Derived | Kind::Quantifier => (Role::Formula, given > 1),
            Kind::Operands | Kind::Value => (Role::Expression, given > 1),
            Kind::Metric => (Role::Expression, given != 1),
            Kind::Arithmetic => (Role::Expression, false),
            Kind::Timed => (Role::Formula, last == Last::List),
            Kind::At | Kind::Atom => (Role::Formula, true),
            Kind::Title | Kind::Words => (Role::Free, true),
            Kind::Free => (Role::Free, false),
        }
    }

    /// Takes a word in: whether it is odd that it stands here.
    fn word(&mut self, word: Word) -> bool {
        if let Kind::New(role) = self.kind {
            return self.first(role, word);
        }
        let given = self.given;
        self.given += 1;
        let now = match (word, self.last) {
            (Word::Dash, _) => Last::Dash,
            (_, Last::Dash) => Last::Type,
            _ => Last::Word,
        };
        let last = std::mem::replace(&mut self.last, now);
        let leads = matches!(word, Word::Connective(_) | Word::Either | Word::Define);
        match self.kind {
            Kind::Fields => match (word, last) {
                (Word::Keyword(_, role), Last::Field(before)) => {
                    self.last = Last::Field(role);
                    before != Role::Words
                }
                (Word::Keyword(_, role), _) => {
                    self.last = Last::Field(role);
                    false
                }
                (_, Last::Field(Role::Words)) => {
                    self.last = last;
                    false
                }
                _ => given > 0,
            },
            Kind::Declarations => match word {
                Word::Dash => last != Last::List,
                _ => last != Last::Dash,
            },
            Kind::Variables | Kind::Private => match word {
                Word::Variable => last == Last::Dash,
                Word::Dash => last != Last::Word,
                _ => last != Last::Dash || leads,
            },
            Kind::Names { .. } if word == Word::Dash => last != Last::Word,
            Kind::Names { .. } | Kind::Words => leads,
            Kind::At => {
                let timed = given == 0 && matches!(word, Word::Time | Word::Number);
                self.kind = if timed { Kind::Timed } else { Kind::Atom };
                leads
            }
            Kind::Atom => leads || word == Word::Dash,
            Kind::Operands => leads || given > 1,
            Kind::Value => leads || given != 1,
            Kind::Metric => leads || given > 0,
            Kind::Title => given > 0,
            Kind::Arithmetic => leads || word == Word::Name,
            // A preference has a name.
            Kind::Loose => match word {
                Word::Name => given > 0,
                _ => word != Word::Number,
            },
            Kind::Free => false,
            Kind::New(_)
            | Kind::Definition
            | Kind::Facts
            | Kind::Formulas { .. }
            | Kind::Derived
            | Kind::Quantifier
            | Kind::Timed => true,
        }
    }

    /// Takes the first word in, which says what the list contains.
    fn first(&mut self, role: Role, word: Word) -> bool {
        let name = !matches!(word, Word::Variable | Word::Dash | Word::Number);
        let (kind, odd) = match (role, word) {
            (Role::Top, Word::Define) => (Kind::Definition, false),
            (Role::Title, _) => (Kind::Title, word != Word::Title),
            (Role::Section, Word::Keyword(kind, _)) => (kind, kind == Kind::Free),
            (Role::Section, _) => (Kind::Free, true),
            (Role::Declaration, Word::Keyword(..)) => (Kind::Private, false),
            (Role::Part, Word::Keyword(..)) => (Kind::Names { keywords: false }, false),
            (Role::Declaration, _) => (Kind::Variables, !name),
            (Role::Type | Role::Part, _) => (Kind::Words, word != Word::Either),
            (Role::Variables, _) => {
                self.kind = Kind::Variables;
                return self.word(word);
            }
            (Role::Fact, Word::Connective(Kind::Operands)) => (Kind::Value, false),
            (Role::Expression, Word::Connective(kind)) => (kind, true),
            (Role::Formula | Role::Fact, Word::Connective(kind))
            | (Role::Formula | Role::Fact | Role::Expression, Word::Ambiguous(kind)) => {
                (kind, false)
            }
            (Role::Expression, Word::Dash) => (Kind::Arithmetic, false),
            (Role::Formula | Role::Fact | Role::Expression, _) => (Kind::Atom, !name),
            (Role::Top | Role::Words | Role::Free, _) => (Kind::Free, false),
        };
        self.kind = kind;
        odd
    }

    /// Whether something is to follow before this list ends.
    fn is_unfinished(self) -> bool {
        match self.kind {
            Kind::New(role) => !matches!(role, Role::Formula | Role::Variables | Role::Free),
            Kind::Definition => self.given == 0,
            Kind::Fields => matches!(self.last, Last::Field(role) if role != Role::Words),
            Kind::Formulas { least, .. } => self.given < least,
            Kind::Derived | Kind::Quantifier | Kind::Operands | Kind::Value | Kind::Metric => {
                self.given < 2
            }
            Kind::Timed => self.last != Last::List,
            Kind::Variables | Kind::Names { .. } => self.last == Last::Dash,
            _ => false,
        }
    }
}
