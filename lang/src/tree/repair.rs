//! A section whose parentheses do not match goes in; the few parentheses to add or to leave out come out.
//!
//! One parenthesis after the other is tried in every place, and the one is taken with which the [`Cost`] is least.
//! A place where the text is still as it must be is not looked at behind the first one where it is not, since a mistake comes before what it causes.

use super::outline::{self, Section};
use super::shape::{Cost, Piece, PieceKind, State, UNEXPECTED};
use super::word::Word;
use crate::lexer::{Token, TokenKind};

/// A change of one parenthesis. Tokens are given by number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Edit {
    /// A `)` is missing after this token.
    Close(u32),
    /// A `(` is missing before this token.
    Open(u32),
    /// This parenthesis is too many.
    Drop(u32),
}

impl Edit {
    /// The token at which it is made.
    pub(super) fn token(self) -> u32 {
        match self {
            Self::Close(token) | Self::Open(token) | Self::Drop(token) => token,
        }
    }
}

/// What is to be done in a section.
#[derive(Debug, Default)]
pub(super) struct Repair {
    /// In the order of the text.
    pub(super) edits: Vec<Edit>,
    /// The first keyword that stands where none can stand.
    pub(super) misplaced: Option<u32>,
}

/// How many parentheses of a section are repaired one by one.
const EDITS: usize = 12;

/// A section with more parentheses and words is searched near its first oddity only.
const LONG: usize = 1500;

/// How many places of a long section are searched before an oddity.
const NEAR: usize = 150;

/// How deep a section may be nested that is searched.
const DEEP: usize = 400;

/// What it costs to leave out a parenthesis at the start of a line, measured in lines that are indented oddly.
const DELIBERATE: u32 = 3;

/// How many steps it takes to go back to a place.
const COPY: usize = 8;

/// How many steps the repairs of one text may take, so that a text full of mistakes is read fast too.
pub(super) const STEPS: usize = 6_000_000;

/// Repairs the section from `section.start` to the token `end`, where `depth` lists should be open.
pub(super) fn repair(
    text: &str,
    tokens: &[Token],
    section: &Section,
    end: u32,
    depth: u32,
    steps: &mut usize,
) -> Repair {
    let mut search = Search {
        pieces: pieces(text, tokens, section.start, end),
        closed: (end as usize == tokens.len()).then_some(0),
        lines: Vec::new(),
        base: section.depth,
        depth: depth as usize,
        steps,
    };
    let mut repair = Repair::default();
    for _ in 0..EDITS {
        let Some((first, now)) = search.look() else { break };
        if repair.edits.is_empty() {
            repair.misplaced = first.misplaced.map(|at| search.pieces[at].token);
        }
        if now.impossible == 0 {
            break;
        }
        let Some((change, at)) = search.best(&first, now) else { break };
        repair.edits.push(search.apply(change, at));
    }
    repair.edits.sort_by_key(|edit| (edit.token(), matches!(edit, Edit::Close(_))));
    repair
}

/// The parentheses and words of a part of the text.
fn pieces(text: &str, tokens: &[Token], start: u32, end: u32) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut starts_line = start == 0;
    let mut wrapped = start;
    for index in start..end {
        if starts_line && index >= wrapped {
            wrapped = comment_end(text, tokens, index, end);
        }
        if index < wrapped {
            continue;
        }
        let token = tokens[index as usize];
        let slice = &text[token.start as usize..token.end as usize];
        let kind = match token.kind {
            TokenKind::Space => {
                starts_line |= slice.contains(['\n', '\r']);
                continue;
            }
            TokenKind::Comment => continue,
            TokenKind::Open => PieceKind::Open,
            TokenKind::Close => PieceKind::Close,
            TokenKind::Atom => {
                let first = pieces.last().is_none_or(|last| last.kind == PieceKind::Open);
                PieceKind::Word(Word::read(slice, first))
            }
        };
        let starts = std::mem::replace(&mut starts_line, false) || index == start;
        let indent = outline::indent(text, token.start as usize).filter(|_| starts);
        pieces.push(Piece { kind, token: index, indent: indent.map(|indent| indent as u32) });
    }
    pieces
}

/// The token after the words that start at `index`, if they have a line of their own below a comment: that comment was wrapped, and they belong to it.
fn comment_end(text: &str, tokens: &[Token], index: u32, end: u32) -> u32 {
    let breaks = |token: &Token| {
        token.kind == TokenKind::Space
            && text[token.start as usize..token.end as usize].contains(['\n', '\r'])
    };
    let (before, after) = tokens[..end as usize].split_at(index as usize);
    let below = matches!(before, [.., comment, blank] if comment.kind == TokenKind::Comment && breaks(blank));
    let words = after
        .iter()
        .take_while(|token| {
            !breaks(token) && matches!(token.kind, TokenKind::Atom | TokenKind::Space)
        })
        .count();
    let alone = after.get(words).is_none_or(breaks);
    let keyword = after.first().is_some_and(|token| text[token.start as usize..].starts_with(':'));
    if below && alone && words > 0 && !keyword { index + words as u32 } else { index }
}

/// A parenthesis that is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Change {
    /// `)` before the piece.
    Close,
    /// `(` before the piece.
    Open,
    /// Without the piece.
    Drop,
}

/// Where things go wrong first, as positions of pieces.
struct First {
    odd: usize,
    impossible: usize,
    misplaced: Option<usize>,
}

struct Search<'s> {
    pieces: Vec<Piece>,
    /// How many lists end with the text, if these pieces are the last ones.
    closed: Option<usize>,
    /// The number of the line on which each piece stands.
    lines: Vec<u32>,
    base: u32,
    depth: usize,
    steps: &'s mut usize,
}

impl Search<'_> {
    /// Reads the pieces as they are; nothing if there are too many of them, or they are nested too deep.
    fn look(&mut self) -> Option<(First, Cost)> {
        *self.steps = self.steps.checked_sub(self.pieces.len())?;
        let end = self.pieces.len();
        let mut first = First { odd: end, impossible: end, misplaced: None };
        let mut state = State::new(self.base, self.depth);
        for (at, &piece) in self.pieces.iter().enumerate() {
            let before = state.cost;
            state.step(piece);
            if state.cost.odd >= before.odd + UNEXPECTED {
                first.odd = first.odd.min(at);
            }
            if state.cost.impossible > before.impossible {
                first.impossible = first.impossible.min(at);
                if matches!(piece.kind, PieceKind::Word(_)) {
                    first.misplaced = first.misplaced.or(Some(at));
                }
            }
            if state.depth() > DEEP {
                return None;
            }
        }
        Some((first, finish(state, self.closed)))
    }

    /// The change with which the cost is least, if some change helps.
    ///
    /// Of equal ones the last in the text is taken, but among other `)` one is added on the first line:
    /// the lists that end there may be those that were left open, and the ones that end below them need not.
    fn best(&mut self, first: &First, now: Cost) -> Option<(Change, usize)> {
        let end = self.pieces.len();
        let last = first.impossible.min(end);
        let near = |place: usize| place.saturating_sub(NEAR)..(place + 2).min(last + 1);
        let places: Vec<usize> = if end <= LONG {
            (0..=last).collect()
        } else {
            let mut places: Vec<usize> = near(first.odd.min(last)).chain(near(last)).collect();
            places.sort_unstable();
            places.dedup();
            places
        };
        self.lines.clear();
        self.lines.extend(self.pieces.iter().scan(0, |line, piece| {
            *line += u32::from(piece.indent.is_some());
            Some(*line)
        }));
        let mut states = Vec::with_capacity(places.len());
        let mut state = State::new(self.base, self.depth);
        let mut read = 0;
        for &place in &places {
            self.pieces[read..place].iter().for_each(|&piece| state.step(piece));
            read = place;
            states.push(state.clone());
        }
        let mut least = Cost { impossible: now.impossible - 1, odd: u32::MAX };
        let mut best: Option<(Change, usize)> = None;
        for (&place, state) in places.iter().zip(&states).rev() {
            for change in self.changes(place) {
                let Some(cost) = self.cost(state, change, place, least) else { continue };
                let earlier = |&(other, at): &(Change, usize)| {
                    let between = &self.pieces[place..at];
                    let is_close = other == Change::Close && change == Change::Close;
                    is_close
                        && between.iter().all(|piece| piece.kind == PieceKind::Close)
                        && self.lines[place - 1] < self.lines[at - 1]
                };
                if cost < least || best.as_ref().is_none_or(earlier) {
                    (least, best) = (cost, Some((change, place)));
                }
            }
        }
        best
    }

    /// What can be tried at a place, the likeliest first.
    fn changes(&self, place: usize) -> impl Iterator<Item = Change> + use<> {
        let here = self.pieces.get(place).map(|piece| piece.kind);
        let before = place.checked_sub(1).map(|before| self.pieces[before].kind);
        let open = (here == Some(PieceKind::Open)).then_some(Change::Drop);
        let close = (here == Some(PieceKind::Close)).then_some(Change::Drop);
        let inserts = self.ends(Change::Close, place)
            || before.is_some_and(|before| before != PieceKind::Open);
        let insert = inserts.then_some(Change::Close);
        let starts = match here {
            Some(PieceKind::Word(_)) => before != Some(PieceKind::Open),
            // The value of a field may be empty.
            Some(PieceKind::Close) => {
                matches!(before, Some(PieceKind::Word(Word::Keyword(..))))
            }
            _ => false,
        };
        let start = starts.then_some(Change::Open);
        [insert, close, start, open].into_iter().flatten()
    }

    /// The cost with a change, if it is not more than `limit`.
    fn cost(&mut self, state: &State, change: Change, place: usize, limit: Cost) -> Option<Cost> {
        if change == Change::Open && state.is_in_words() {
            return None;
        }
        let mut state = state.clone();
        let (changed, rest) = self.changed(change, place);
        changed.into_iter().flatten().for_each(|piece| state.step(piece));
        let closed = self.closed.map(|closed| closed + usize::from(self.ends(change, place)));
        // What stands at the start of a line was put there on purpose.
        let starts = change == Change::Drop && self.pieces[place].indent.is_some();
        state.cost.odd += DELIBERATE * u32::from(starts);
        for (read, &piece) in self.pieces.iter().skip(rest).enumerate() {
            if state.cost > limit {
                *self.steps = self.steps.saturating_sub(read + COPY);
                return None;
            }
            state.step(piece);
        }
        *self.steps = self.steps.saturating_sub(self.pieces.len() - place + COPY);
        let cost = finish(state, closed);
        (cost <= limit).then_some(cost)
    }

    /// Whether a change ends a list with the text.
    fn ends(&self, change: Change, place: usize) -> bool {
        change == Change::Close && place == self.pieces.len() && self.closed.is_some()
    }

    /// What stands at a place after a change, and the piece with which the text goes on.
    fn changed(&self, change: Change, place: usize) -> ([Option<Piece>; 2], usize) {
        let here = self.pieces.get(place).copied();
        let token = here.map_or(0, |piece| piece.token);
        let new = |kind, token, indent| Some(Piece { kind, token, indent });
        match change {
            Change::Close if self.ends(change, place) => ([None; 2], place),
            Change::Close => {
                let before = place.checked_sub(1).map_or(0, |before| self.pieces[before].token);
                ([new(PieceKind::Close, before, None), None], place)
            }
            Change::Open => {
                let indent = here.and_then(|piece| piece.indent);
                let open = new(PieceKind::Open, token, indent);
                ([open, here.map(|piece| Piece { indent: None, ..piece })], place + 1)
            }
            Change::Drop => {
                // What follows on the line starts it now.
                let indent = here.and_then(|piece| piece.indent);
                let next = self.pieces.get(place + 1).copied();
                let next = next.map(|next| Piece { indent: next.indent.or(indent), ..next });
                ([next, None], place + 2)
            }
        }
    }

    fn apply(&mut self, change: Change, place: usize) -> Edit {
        let (changed, rest) = self.changed(change, place);
        let edit = match change {
            Change::Close => Edit::Close(self.pieces[place - 1].token),
            Change::Open => Edit::Open(self.pieces[place].token),
            Change::Drop => Edit::Drop(self.pieces[place].token),
        };
        let rest = rest.min(self.pieces.len());
        if self.ends(change, place) {
            self.closed = self.closed.map(|closed| closed + 1);
        }
        self.pieces.splice(place..rest, changed.into_iter().flatten());
        edit
    }
}

/// The cost at the end of the section, or of the text if so many lists end with it.
fn finish(state: State, closed: Option<usize>) -> Cost {
    match closed {
        Some(closed) => state.cut(closed),
        None => state.finish(),
    }
}
