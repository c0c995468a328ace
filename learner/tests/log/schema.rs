//! A line and what it should be go in; a panic comes out where `docs/log.schema.json` says otherwise.

use serde_json::Value;

/// Holds a line against a definition of the schema.
pub fn check(line: &str, definition: &str) {
    let schema: Value = serde_json::from_str(include_str!("../../../docs/log.schema.json"))
        .expect("the schema is JSON");
    let value: Value = serde_json::from_str(line).expect("a line is JSON");
    if let Err(message) = conforms(&value, &schema["$defs"][definition], &schema) {
        panic!("{message}\n{line}");
    }
}

/// As much of JSON Schema as the schema of logs uses.
fn conforms(value: &Value, schema: &Value, root: &Value) -> Result<(), String> {
    if let Some(path) = schema["$ref"].as_str() {
        let named = root.pointer(path.trim_start_matches('#'));
        return conforms(value, named.expect("what is named exists"), root);
    }
    if let Some(options) = schema["oneOf"].as_array() {
        let fit = options.iter().filter(|option| conforms(value, option, root).is_ok()).count();
        return if fit == 1 {
            Ok(())
        } else {
            Err(format!("{value} fits {fit} of {} forms", options.len()))
        };
    }
    if schema.get("const").is_some_and(|wanted| wanted != value) {
        return Err(format!("{value} is not {}", schema["const"]));
    }
    if schema["enum"].as_array().is_some_and(|choice| !choice.contains(value)) {
        return Err(format!("{value} is none of {}", schema["enum"]));
    }
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let fits = match &schema["type"] {
        Value::String(wanted) => wanted == kind,
        Value::Array(wanted) => wanted.iter().any(|one| one == kind),
        _ => true,
    };
    if !fits {
        return Err(format!("{value} is no {}", schema["type"]));
    }
    if let Some(number) = value.as_f64() {
        let above = |key: &str| schema[key].as_f64().is_none_or(|least| number >= least);
        let below = schema["maximum"].as_f64().is_none_or(|most| number <= most);
        let strict = schema["exclusiveMinimum"].as_f64().is_none_or(|least| number > least);
        if !(above("minimum") && below && strict) {
            return Err(format!("{number} is out of range"));
        }
    }
    if let Some(items) = value.as_array() {
        let count = items.len() as u64;
        let few = schema["minItems"].as_u64().is_some_and(|least| count < least);
        let many = schema["maxItems"].as_u64().is_some_and(|most| count > most);
        if few || many {
            return Err(format!("{value} has {count} items"));
        }
        items.iter().try_for_each(|item| conforms(item, &schema["items"], root))?;
    }
    let Some(fields) = value.as_object() else { return Ok(()) };
    for required in schema["required"].as_array().into_iter().flatten() {
        let name = required.as_str().expect("a name");
        if !fields.contains_key(name) {
            return Err(format!("{name} is missing in {value}"));
        }
    }
    for (name, field) in fields {
        match schema["properties"].get(name).or(schema.get("additionalProperties")) {
            Some(Value::Bool(false)) | None => return Err(format!("{name} is not described")),
            Some(schema) => conforms(field, schema, root)?,
        }
    }
    Ok(())
}
