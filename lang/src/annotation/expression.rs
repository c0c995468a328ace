//! An [`Expression`]: an s-expression of an annotation as a flat list of [`Item`]s, each with its place in the file.
//!
//! Nothing here recurses on the depth of an expression.

use std::fmt;

use crate::source::Span;

/// What an [`Item`] is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Value {
    /// `( … )`
    List,
    /// One word: a name, a number, a variable with its `?`, or a keyword with its `:`.
    Word(String),
    /// What stands between double quotes.
    Text(String),
}

/// A list, a word or a text of an [`Expression`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// What it is.
    pub value: Value,
    /// Where it stands in the file. That of a list may run over several lines, with the `;@` that they begin with.
    pub span: Span,
    /// The item after this one and everything in it.
    pub next: u32,
}

/// Names an item of the [`Expression`] at hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ItemId(pub u32);

/// One s-expression of an annotation: its items in the order of the text, each list before what it contains.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expression {
    pub(super) items: Vec<Item>,
}

impl Expression {
    /// The list that the whole expression is.
    pub const ROOT: ItemId = ItemId(0);

    /// All items.
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    /// The item that `id` names.
    pub fn item(&self, id: ItemId) -> &Item {
        &self.items[id.0 as usize]
    }

    /// Where the item stands.
    pub fn span(&self, id: ItemId) -> Span {
        self.item(id).span
    }

    /// The word that the item is, if it is one.
    pub fn word(&self, id: ItemId) -> Option<&str> {
        match &self.item(id).value {
            Value::Word(word) => Some(word),
            _ => None,
        }
    }

    /// Whether the item is a list.
    pub fn is_list(&self, id: ItemId) -> bool {
        self.item(id).value == Value::List
    }

    /// What stands directly in the list `id`; nothing if it is no list.
    pub fn children(&self, id: ItemId) -> Children<'_> {
        Children { items: &self.items, at: id.0 + 1, end: self.item(id).next }
    }

    /// The first word of the list `id`, if it begins with a word.
    pub fn head(&self, id: ItemId) -> Option<&str> {
        self.children(id).next().and_then(|first| self.word(first))
    }
}

/// Walks over items that stand side by side.
#[derive(Debug, Clone)]
pub struct Children<'e> {
    items: &'e [Item],
    at: u32,
    end: u32,
}

impl Iterator for Children<'_> {
    type Item = ItemId;

    fn next(&mut self) -> Option<ItemId> {
        (self.at < self.end).then(|| {
            let id = self.at;
            self.at = self.items[id as usize].next;
            ItemId(id)
        })
    }
}

/// On one line, with one blank between neighbours.
impl fmt::Display for Expression {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut open: Vec<u32> = Vec::new();
        let mut after_open = true;
        for (at, item) in self.items.iter().enumerate() {
            while open.pop_if(|next| *next <= at as u32).is_some() {
                out.write_str(")")?;
                after_open = false;
            }
            if !after_open {
                out.write_str(" ")?;
            }
            after_open = item.value == Value::List;
            match &item.value {
                Value::List => {
                    out.write_str("(")?;
                    open.push(item.next);
                }
                Value::Word(word) => out.write_str(word)?,
                Value::Text(text) => write!(out, "\"{text}\"")?,
            }
        }
        open.iter().try_for_each(|_| out.write_str(")"))
    }
}
