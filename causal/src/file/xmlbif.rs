//! XMLBIF 0.3 (Cozman 1998): networks as XML.
//!
//! As in [BIF](super::bif) names are made plain, and what they stood for is kept: in a property of each variable.

use quick_xml::Reader;
use quick_xml::escape::{escape, resolve_predefined_entity};
use quick_xml::events::Event;

use super::Fault;
use super::assemble::{Stated, assemble};
use super::names::plain;
use crate::network::Network;
use crate::variable::{States, Variable, VariableId};

/// What the property of a variable begins with.
const MARK: &str = "caveat_variable = ";

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<BIF VERSION="0.3">
<NETWORK>
<NAME>caveat</NAME>
"#;

/// Writes a network. A row of which nothing is known cannot be written: its name is the error.
pub fn write(network: &Network) -> Result<String, String> {
    let names = plain(network.variables().iter().map(|one| one.name.as_str()), 'v');
    let mut text = HEAD.to_owned();
    for (variable, name) in network.variables().iter().zip(&names) {
        let states = plain(variable.labels().iter().map(String::as_str), 's');
        put!(text, "<VARIABLE TYPE=\"nature\">\n  <NAME>{name}</NAME>\n");
        for state in &states {
            put!(text, "  <OUTCOME>{state}</OUTCOME>\n");
        }
        if *variable != Variable::new(name, States::Categories(states)) {
            // An equals sign can only be within a string; other readers part properties at the first.
            let json = serde_json::to_string(variable)
                .expect("a variable is JSON")
                .replace('=', "\\u003d");
            put!(text, "  <PROPERTY>{MARK}{}</PROPERTY>\n", escape(json));
        }
        text.push_str("</VARIABLE>\n");
    }
    for id in network.ids() {
        put!(text, "<DEFINITION>\n  <FOR>{}</FOR>\n", names[id.index()]);
        for parent in network.graph().parents(id) {
            put!(text, "  <GIVEN>{}</GIVEN>\n", names[parent.index()]);
        }
        if let Some(&row) = network.table(id).unknown.first() {
            return Err(format!(
                "nothing is known of `{}` where {}, and XMLBIF cannot say so: estimate with a prior",
                network.variable(id).name,
                network.row_name(id, row as usize)
            ));
        }
        let numbers: Vec<String> =
            network.table(id).probabilities.iter().map(ToString::to_string).collect();
        put!(text, "  <TABLE>{}</TABLE>\n</DEFINITION>\n", numbers.join(" "));
    }
    text.push_str("</NETWORK>\n</BIF>\n");
    Ok(text)
}

/// The contents of an element VARIABLE or DEFINITION: what its elements hold, and where each begins.
type Contents = Vec<(String, String, usize)>;

/// Reads a network.
pub fn read(text: &str) -> Result<Network, Fault> {
    let mut variables: Vec<Variable> = Vec::new();
    let mut names: Vec<String> = Vec::new();
    let mut definitions: Vec<(Contents, usize)> = Vec::new();
    for (kind, contents, at) in elements(text)? {
        if kind == "DEFINITION" {
            definitions.push((contents, at));
            continue;
        }
        let (name, variable) = variable(text, &contents, at)?;
        if names.contains(&name) {
            return Err(Fault::at(text, at, format!("there are two variables `{name}`")));
        }
        names.push(name);
        variables.push(variable);
    }
    if variables.is_empty() {
        return Err(Fault::at(text, text.len(), "the file has no variable"));
    }
    let stated = definitions
        .iter()
        .map(|(contents, at)| definition(text, contents, *at, &names, &variables))
        .collect::<Result<_, _>>()?;
    assemble(variables, stated, text.len()).map_err(|(what, at)| Fault::at(text, at, what))
}

/// The elements VARIABLE and DEFINITION of a file, in their order.
fn elements(text: &str) -> Result<Vec<(String, Contents, usize)>, Fault> {
    let mut reader = Reader::from_str(text);
    let mut found: Vec<(String, Contents, usize)> = Vec::new();
    let mut open: Vec<String> = Vec::new();
    loop {
        let at = reader.buffer_position() as usize;
        let event = reader.read_event().map_err(|error| {
            Fault::at(text, reader.error_position() as usize, error.to_string())
        })?;
        let inside = open.iter().any(|name| name == "VARIABLE" || name == "DEFINITION");
        match event {
            Event::Start(start) => {
                let name = start.name().into_inner().to_owned();
                if inside {
                    let (_, contents, _) = found.last_mut().expect("an element was begun");
                    contents.push((name.clone(), String::new(), at));
                } else if name == "VARIABLE" || name == "DEFINITION" {
                    found.push((name.clone(), Vec::new(), at));
                }
                open.push(name);
            }
            Event::End(_) => {
                open.pop();
            }
            Event::Text(piece) => gather(&mut found, inside, &piece),
            Event::CData(piece) => gather(&mut found, inside, &piece),
            Event::GeneralRef(reference) => {
                let character = reference.resolve_char_ref().ok().flatten().map(String::from);
                let resolved = character
                    .or_else(|| resolve_predefined_entity(&reference).map(ToOwned::to_owned));
                let Some(resolved) = resolved else {
                    return Err(Fault::at(
                        text,
                        at,
                        format!("nobody knows what `&{};` is", &*reference),
                    ));
                };
                gather(&mut found, inside, &resolved);
            }
            Event::Eof if open.is_empty() => return Ok(found),
            Event::Eof => {
                let what = format!("the file ends within <{}>", open.join("><"));
                return Err(Fault::at(text, text.len(), what));
            }
            _ => {}
        }
    }
}

/// Adds text to the element that was begun last.
fn gather(found: &mut [(String, Contents, usize)], inside: bool, piece: &str) {
    if let Some((_, contents, _)) = found.last_mut().filter(|_| inside)
        && let Some((_, text, _)) = contents.last_mut()
    {
        text.push_str(piece);
    }
}

fn texts<'a>(contents: &'a Contents, name: &'a str) -> impl Iterator<Item = (&'a str, usize)> {
    contents.iter().filter(move |(one, ..)| one == name).map(|(_, text, at)| (text.trim(), *at))
}

fn variable(text: &str, contents: &Contents, at: usize) -> Result<(String, Variable), Fault> {
    let Some((name, _)) = texts(contents, "NAME").next() else {
        return Err(Fault::at(text, at, "this variable has no <NAME>"));
    };
    let states: Vec<&str> = texts(contents, "OUTCOME").map(|(state, _)| state).collect();
    if states.is_empty() || states.len() > crate::variable::MOST_STATES {
        let what = format!("`{name}` has {} states; it can have 1 to 256", states.len());
        return Err(Fault::at(text, at, what));
    }
    for (number, state) in states.iter().enumerate() {
        if states[..number].contains(state) {
            return Err(Fault::at(text, at, format!("`{name}` has two states `{state}`")));
        }
    }
    let told = Variable::of_words(name, states.iter().copied());
    let marked = texts(contents, "PROPERTY")
        .find_map(|(property, at)| Some((property.strip_prefix(MARK)?, at)));
    let Some((json, at)) = marked else { return Ok((name.to_owned(), told)) };
    match serde_json::from_str::<Variable>(json) {
        Ok(variable) if variable.arity() == states.len() => Ok((name.to_owned(), variable)),
        Ok(_) => {
            Err(Fault::at(text, at, "this property has another number of states than the variable"))
        }
        Err(error) => Err(Fault::at(text, at, format!("this property is no variable: {error}"))),
    }
}

fn definition(
    text: &str,
    contents: &Contents,
    at: usize,
    names: &[String],
    variables: &[Variable],
) -> Result<Stated, Fault> {
    let find = |(name, at): (&str, usize)| {
        let place = names.iter().position(|one| one == name).map(|at| VariableId(at as u16));
        place.ok_or_else(|| {
            let help = lang::did_you_mean(name, names.iter().map(String::as_str));
            Fault::at(text, at, format!("there is no variable `{name}`{help}"))
        })
    };
    let Some(whose) = texts(contents, "FOR").next() else {
        return Err(Fault::at(text, at, "this definition has no <FOR>"));
    };
    let child = find(whose)?;
    let parents: Vec<VariableId> = texts(contents, "GIVEN").map(find).collect::<Result<_, _>>()?;
    for (place, parent) in parents.iter().enumerate() {
        if *parent == child || parents[..place].contains(parent) {
            let what = format!("`{}` comes twice in one table", names[parent.index()]);
            return Err(Fault::at(text, at, what));
        }
    }
    let Some((numbers, at)) = texts(contents, "TABLE").next() else {
        return Err(Fault::at(text, at, format!("`{}` has no <TABLE>", whose.0)));
    };
    let number = |word: &str| {
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| Fault::at(text, at, format!("`{word}` is no probability")))
    };
    let probabilities: Vec<f64> =
        numbers.split_whitespace().map(number).collect::<Result<_, _>>()?;
    let arity = |id: &VariableId| variables[id.index()].arity() as u128;
    let cells = parents.iter().map(arity).product::<u128>() * arity(&child);
    if probabilities.len() as u128 != cells {
        let what = format!(
            "the table of `{}` should have {cells} numbers, and has {}",
            whose.0,
            probabilities.len()
        );
        return Err(Fault::at(text, at, what));
    }
    Ok(Stated { child, parents, probabilities, at })
}
