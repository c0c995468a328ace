//! The Interchange Format for Bayesian Networks (Cozman 1998), as the networks of the literature are written in it.
//!
//! What is written is read by other tools: names are made plain, and what they stood for is kept in a comment above each variable, from
//! which it is restored. Rows are read by the states that they name, never by their place; numbers are kept as they are read.

use std::collections::HashMap;

use super::Fault;
use super::assemble::{Stated, assemble};
use super::names::plain;
use crate::network::Network;
use crate::variable::{States, Variable, VariableId};

/// What the comment above a variable begins with.
const MARK: &str = "caveat-variable ";

/// Writes a network. A row of which nothing is known cannot be written: its name is the error.
pub fn write(network: &Network) -> Result<String, String> {
    let names = plain(network.variables().iter().map(|one| one.name.as_str()), 'v');
    let states: Vec<Vec<String>> = network
        .variables()
        .iter()
        .map(|one| plain(one.labels().iter().map(String::as_str), 's'))
        .collect();
    let mut text = String::from("network caveat {\n}\n");
    for ((variable, name), states) in network.variables().iter().zip(&names).zip(&states) {
        let told = Variable::new(name, States::Categories(states.clone()));
        if *variable != told {
            let json = serde_json::to_string(variable).expect("a variable is JSON");
            put!(text, "// {MARK}{json}\n");
        }
        put!(
            text,
            "variable {name} {{\n  type discrete [ {} ] {{ {} }};\n}}\n",
            states.len(),
            states.join(", ")
        );
    }
    for id in network.ids() {
        let parents = network.graph().parents(id);
        let rows = network.rows(id).expect("the rows of a network are numbered");
        let numbers = |row: usize| -> Result<String, String> {
            let Some(row) = network.row(id, row) else {
                return Err(format!(
                    "nothing is known of `{}` where {}, and BIF cannot say so: estimate with a prior",
                    network.variable(id).name,
                    network.row_name(id, row)
                ));
            };
            Ok(row.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))
        };
        if parents.is_empty() {
            put!(text, "probability ( {} ) {{\n  table {};\n}}\n", names[id.index()], numbers(0)?);
            continue;
        }
        let given: Vec<&str> =
            parents.iter().map(|parent| names[parent.index()].as_str()).collect();
        put!(text, "probability ( {} | {} ) {{\n", names[id.index()], given.join(", "));
        for row in 0..rows {
            let tuple: Vec<&str> = parents
                .iter()
                .zip(network.states_of(id, row))
                .map(|(parent, state)| states[parent.index()][usize::from(state)].as_str())
                .collect();
            put!(text, "  ({}) {};\n", tuple.join(", "), numbers(row)?);
        }
        text.push_str("}\n");
    }
    Ok(text)
}

/// A piece of the text, and where it begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Token<'a> {
    Word(&'a str),
    Sign(char),
    /// What a comment says of the variable that follows.
    Mark(&'a str),
    End,
}

/// Reads the text from front to back.
struct Reader<'a> {
    text: &'a str,
    at: usize,
    /// Where the token that was read last begins.
    start: usize,
}

impl<'a> Reader<'a> {
    fn fault(&self, what: impl Into<String>) -> Fault {
        Fault::at(self.text, self.start, what)
    }

    /// The next token; comments and white space are passed over.
    fn next(&mut self) -> Result<Token<'a>, Fault> {
        loop {
            let rest = &self.text[self.at..];
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            self.start = self.at;
            if trimmed.starts_with("//") {
                let line = trimmed.lines().next().unwrap_or(trimmed);
                self.at += line.len();
                if let Some(mark) = line[2..].trim().strip_prefix(MARK) {
                    return Ok(Token::Mark(mark));
                }
            } else if trimmed.starts_with("/*") {
                let Some(end) = trimmed.find("*/") else {
                    return Err(self.fault("this comment does not end"));
                };
                self.at += end + 2;
            } else {
                break;
            }
        }
        let rest = &self.text[self.at..];
        let Some(first) = rest.chars().next() else { return Ok(Token::End) };
        if "{}()[]|,;".contains(first) {
            self.at += first.len_utf8();
            return Ok(Token::Sign(first));
        }
        if first == '"' {
            let Some(end) = rest[1..].find('"') else {
                return Err(self.fault("this text in quotes does not end"));
            };
            self.at += end + 2;
            return Ok(Token::Word(&rest[1..=end]));
        }
        let ends = |one: char| one.is_whitespace() || "{}()[]|,;\"".contains(one);
        let end = rest.find(ends).unwrap_or(rest.len());
        self.at += end;
        Ok(Token::Word(&rest[..end]))
    }

    fn peek(&mut self) -> Result<Token<'a>, Fault> {
        let (at, start) = (self.at, self.start);
        let token = self.next();
        self.at = at;
        let token = token?;
        self.start = start;
        Ok(token)
    }

    fn sign(&mut self, sign: char) -> Result<(), Fault> {
        match self.next()? {
            Token::Sign(found) if found == sign => Ok(()),
            other => Err(self.fault(format!("`{sign}` should stand here, not {}", said(other)))),
        }
    }

    fn word(&mut self, what: &str) -> Result<&'a str, Fault> {
        match self.next()? {
            Token::Word(word) => Ok(word),
            other => Err(self.fault(format!("{what} should stand here, not {}", said(other)))),
        }
    }

    /// Words between commas, to a sign that ends them. Commas may be left out.
    fn words(&mut self, what: &str, end: char) -> Result<Vec<(&'a str, usize)>, Fault> {
        let mut words = Vec::new();
        loop {
            match self.next()? {
                Token::Word(word) => words.push((word, self.start)),
                Token::Sign(',') => {}
                Token::Sign(sign) if sign == end => return Ok(words),
                other => {
                    return Err(self.fault(format!(
                        "{what} or `{end}` should stand here, not {}",
                        said(other)
                    )));
                }
            }
        }
    }

    fn numbers(&mut self) -> Result<Vec<f64>, Fault> {
        let words = self.words("a probability", ';')?;
        let number = |(word, at): (&str, usize)| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| Fault::at(self.text, at, format!("`{word}` is no probability")))
        };
        words.into_iter().map(number).collect()
    }

    /// Passes over a property, to its end.
    fn property(&mut self) -> Result<(), Fault> {
        loop {
            match self.next()? {
                Token::Sign(';') => return Ok(()),
                Token::End => return Err(self.fault("the file ends within a property")),
                _ => {}
            }
        }
    }
}

fn said(token: Token) -> String {
    match token {
        Token::Word(word) => format!("`{word}`"),
        Token::Sign(sign) => format!("`{sign}`"),
        Token::Mark(_) => "a comment about a variable".to_owned(),
        Token::End => "the end of the file".to_owned(),
    }
}

/// The variables of a file so far, with the names that they have in it.
#[derive(Default)]
struct Declared<'a> {
    variables: Vec<Variable>,
    ids: HashMap<&'a str, VariableId>,
    states: Vec<HashMap<&'a str, usize>>,
}

/// Reads a network.
pub fn read(text: &str) -> Result<Network, Fault> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = Reader { text, at: 0, start: 0 };
    let mut declared = Declared::default();
    let mut stated: Vec<Stated> = Vec::new();
    let mut mark = None;
    loop {
        match reader.next()? {
            Token::End => break,
            Token::Mark(json) => mark = Some((json, reader.start)),
            Token::Word("network") => {
                while reader.next()? != Token::Sign('{') {
                    if reader.peek()? == Token::End {
                        return Err(reader.fault("the file ends within its first declaration"));
                    }
                }
                while reader.next()? != Token::Sign('}') {
                    if reader.peek()? == Token::End {
                        return Err(reader.fault("the file ends within its first declaration"));
                    }
                }
            }
            Token::Word("variable") => variable(&mut reader, &mut declared, mark.take())?,
            Token::Word("probability") => stated.push(probability(&mut reader, &declared)?),
            Token::Word("property") => reader.property()?,
            other => {
                let what = format!(
                    "`network`, `variable` or `probability` should stand here, not {}",
                    said(other)
                );
                return Err(reader.fault(what));
            }
        }
    }
    if declared.variables.is_empty() {
        return Err(reader.fault("the file has no variable"));
    }
    assemble(declared.variables, stated, text.len()).map_err(|(what, at)| Fault::at(text, at, what))
}

fn variable<'a>(
    reader: &mut Reader<'a>,
    declared: &mut Declared<'a>,
    mark: Option<(&str, usize)>,
) -> Result<(), Fault> {
    let name = reader.word("the name of a variable")?;
    let place = reader.start;
    reader.sign('{')?;
    let mut states: Option<Vec<(&str, usize)>> = None;
    loop {
        match reader.next()? {
            Token::Sign('}') => break,
            Token::Word("property") => reader.property()?,
            Token::Word("type") => {
                let kind = reader.word("`discrete`")?;
                if kind != "discrete" {
                    return Err(reader.fault(format!(
                        "`{name}` is {kind}; only discrete variables can be read"
                    )));
                }
                reader.sign('[')?;
                let number = reader.word("the number of states")?;
                let at = reader.start;
                reader.sign(']')?;
                reader.sign('{')?;
                let found = reader.words("a state", '}')?;
                reader.sign(';')?;
                if number.parse() != Ok(found.len()) {
                    let what = format!(
                        "`{name}` should have {number} states, and {} are named",
                        found.len()
                    );
                    return Err(Fault::at(reader.text, at, what));
                }
                states = Some(found);
            }
            other => {
                return Err(
                    reader.fault(format!("`type` or `}}` should stand here, not {}", said(other)))
                );
            }
        }
    }
    let Some(states) = states else {
        return Err(Fault::at(reader.text, place, format!("`{name}` has no states")));
    };
    if states.is_empty() || states.len() > crate::variable::MOST_STATES {
        let what = format!("`{name}` has {} states; it can have 1 to 256", states.len());
        return Err(Fault::at(reader.text, place, what));
    }
    let mut numbers = HashMap::new();
    for (number, &(state, at)) in states.iter().enumerate() {
        if numbers.insert(state, number).is_some() {
            return Err(Fault::at(reader.text, at, format!("`{name}` has two states `{state}`")));
        }
    }
    let told = || Variable::of_words(name, states.iter().map(|&(state, _)| state));
    let variable = match mark {
        None => told(),
        Some((json, at)) => match serde_json::from_str::<Variable>(json) {
            Ok(variable) if variable.arity() == states.len() => variable,
            Ok(_) => {
                return Err(Fault::at(
                    reader.text,
                    at,
                    "this comment has another number of states than the variable",
                ));
            }
            Err(error) => {
                return Err(Fault::at(
                    reader.text,
                    at,
                    format!("this comment is no variable: {error}"),
                ));
            }
        },
    };
    let id = VariableId(declared.variables.len() as u16);
    if declared.ids.insert(name, id).is_some() {
        return Err(Fault::at(reader.text, place, format!("there are two variables `{name}`")));
    }
    declared.variables.push(variable);
    declared.states.push(numbers);
    Ok(())
}

fn probability(reader: &mut Reader, declared: &Declared) -> Result<Stated, Fault> {
    let place = reader.start;
    reader.sign('(')?;
    let find = |reader: &Reader, name: &str| {
        declared.ids.get(name).copied().ok_or_else(|| {
            let help = lang::did_you_mean(name, declared.ids.keys().copied());
            reader.fault(format!("there is no variable `{name}`{help}"))
        })
    };
    let name = reader.word("the name of a variable")?;
    let child = find(reader, name)?;
    let mut parents: Vec<VariableId> = Vec::new();
    loop {
        match reader.next()? {
            Token::Sign(')') => break,
            Token::Sign('|' | ',') => {}
            Token::Word(name) => {
                let parent = find(reader, name)?;
                if parent == child || parents.contains(&parent) {
                    return Err(reader.fault(format!("`{name}` comes twice in one table")));
                }
                parents.push(parent);
            }
            other => {
                return Err(
                    reader.fault(format!("a parent or `)` should stand here, not {}", said(other)))
                );
            }
        }
    }
    reader.sign('{')?;
    let arity = |id: VariableId| declared.variables[id.index()].arity();
    let cells =
        parents.iter().map(|&id| arity(id) as u128).product::<u128>() * arity(child) as u128;
    if cells > crate::count::MOST_CELLS as u128 {
        return Err(Fault::at(
            reader.text,
            place,
            format!("the table of `{name}` has {cells} cells, too many"),
        ));
    }
    let rows = cells as usize / arity(child);
    let mut filled: Vec<Option<Vec<f64>>> = vec![None; rows];
    let mut default = None;
    loop {
        match reader.next()? {
            Token::Sign('}') => break,
            Token::Word("property") => reader.property()?,
            Token::Word("table") => {
                let at = reader.start;
                let numbers = reader.numbers()?;
                if numbers.len() as u128 != cells {
                    let what = format!(
                        "the table of `{name}` should have {cells} numbers, and has {}",
                        numbers.len()
                    );
                    return Err(Fault::at(reader.text, at, what));
                }
                // In a table without states the child's run slowest (Cozman 1998).
                for (row, filled) in filled.iter_mut().enumerate() {
                    *filled =
                        Some((0..arity(child)).map(|state| numbers[state * rows + row]).collect());
                }
            }
            Token::Word("default") => {
                let at = reader.start;
                let numbers = reader.numbers()?;
                check(reader, name, at, &numbers, arity(child))?;
                default = Some(numbers);
            }
            Token::Sign('(') => {
                let at = reader.start;
                let tuple = reader.words("a state", ')')?;
                if tuple.len() != parents.len() {
                    let what = format!(
                        "`{name}` has {} parents, and {} states are named",
                        parents.len(),
                        tuple.len()
                    );
                    return Err(Fault::at(reader.text, at, what));
                }
                let mut row = 0;
                for (&parent, (state, at)) in parents.iter().zip(tuple) {
                    let Some(number) = declared.states[parent.index()].get(state) else {
                        let what = format!(
                            "`{}` has no state `{state}`",
                            declared.variables[parent.index()].name
                        );
                        return Err(Fault::at(reader.text, at, what));
                    };
                    row = row * arity(parent) + number;
                }
                let numbers = reader.numbers()?;
                check(reader, name, at, &numbers, arity(child))?;
                if filled[row].replace(numbers).is_some() {
                    return Err(Fault::at(reader.text, at, format!("`{name}` has this row twice")));
                }
            }
            other => {
                let what = format!(
                    "a row of probabilities or `}}` should stand here, not {}",
                    said(other)
                );
                return Err(reader.fault(what));
            }
        }
    }
    let mut probabilities = Vec::with_capacity(cells as usize);
    for row in filled {
        let Some(row) = row.as_ref().or(default.as_ref()) else {
            let what = format!("the table of `{name}` has {rows} rows, and some are missing");
            return Err(Fault::at(reader.text, place, what));
        };
        probabilities.extend_from_slice(row);
    }
    Ok(Stated { child, parents, probabilities, at: place })
}

/// Whether a row has a number for each state.
fn check(
    reader: &Reader,
    name: &str,
    at: usize,
    numbers: &[f64],
    arity: usize,
) -> Result<(), Fault> {
    if numbers.len() == arity {
        return Ok(());
    }
    let what =
        format!("this row of `{name}` has {} numbers; there are {arity} states", numbers.len());
    Err(Fault::at(reader.text, at, what))
}
