//! The text of a SAS+ file as Fast Downward's translator writes it goes in (format version 3); a task with its names comes out.

use std::fmt;
use std::ops::Range;
use std::str::{FromStr, Lines};

use crate::task::{Axiom, Effect, Fact, Operator, Task, Variable, VariableId};

/// A task with the names that the file gives.
#[derive(Debug, Clone, Default)]
pub struct Named {
    /// The task.
    pub task: Task,
    /// For each operator its name, without parentheses.
    pub operators: Vec<String>,
    /// For each variable and value the name of the fact.
    pub facts: Vec<Vec<String>>,
}

/// What is wrong with a file, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    /// The line, counted from 1.
    pub line: usize,
    /// What was expected there.
    pub expected: String,
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "line {}: expected {}", self.line, self.expected)
    }
}

impl std::error::Error for Error {}

/// Reads a file of version 3.
pub fn read(text: &str) -> Result<Named, Error> {
    let mut reader = Reader { lines: text.lines(), line: 0, named: Named::default() };
    reader.file()?;
    Ok(reader.named)
}

struct Reader<'t> {
    lines: Lines<'t>,
    line: usize,
    named: Named,
}

impl<'t> Reader<'t> {
    fn file(&mut self) -> Result<(), Error> {
        self.keyword("begin_version")?;
        if self.number::<u32>("the version")? != 3 {
            return Err(self.error("version 3"));
        }
        self.keyword("end_version")?;
        self.keyword("begin_metric")?;
        self.named.task.uses_metric = self.number::<u32>("0 or 1")? == 1;
        self.keyword("end_metric")?;
        self.repeat("the number of variables", Self::variable)?;
        self.repeat("the number of mutex groups", Self::mutex_group)?;
        self.keyword("begin_state")?;
        for index in 0..self.named.task.variables.len() {
            let value = self.number("a value")?;
            let fact = self.fact(index as u32, value)?;
            self.named.task.initial_state.push(fact.value);
            // The file gives the default of a derived variable as its initial value.
            let variable = &mut self.named.task.variables[index];
            variable.default = if variable.axiom_layer.is_some() { value } else { 0 };
        }
        self.keyword("end_state")?;
        self.keyword("begin_goal")?;
        let count = self.number("the number of goal facts")?;
        let mut goal = self.facts(count)?;
        goal.sort_unstable();
        self.named.task.goal = goal;
        self.keyword("end_goal")?;
        self.repeat("the number of operators", Self::operator)?;
        self.repeat("the number of axioms", Self::axiom)?;
        let task = &mut self.named.task;
        task.axioms.sort_by_key(|axiom| task.variables[axiom.head.variable.index()].axiom_layer);
        Ok(())
    }

    fn variable(&mut self) -> Result<(), Error> {
        self.keyword("begin_variable")?;
        self.text("the name of the variable")?;
        let layer: i64 = self.number("the axiom layer")?;
        let domain_size = self.number("the size of the domain")?;
        let names = (0..domain_size)
            .map(|_| self.text("the name of a fact").map(str::to_owned))
            .collect::<Result<_, _>>()?;
        self.keyword("end_variable")?;
        self.named.facts.push(names);
        self.named.task.variables.push(Variable {
            domain_size,
            axiom_layer: u32::try_from(layer).ok(),
            default: 0,
        });
        Ok(())
    }

    fn mutex_group(&mut self) -> Result<(), Error> {
        self.keyword("begin_mutex_group")?;
        let count = self.number("the number of facts")?;
        let facts = self.facts(count)?;
        self.named.task.mutex_groups.push(facts);
        self.keyword("end_mutex_group")
    }

    fn operator(&mut self) -> Result<(), Error> {
        self.keyword("begin_operator")?;
        let name = self.text("the name of the operator")?.to_owned();
        self.named.operators.push(name);
        let count = self.number("the number of prevail conditions")?;
        let mut precondition = self.facts(count)?;
        let first_effect = self.named.task.effect_pool.len() as u32;
        for _ in 0..self.number("the number of effects")? {
            let numbers = self.numbers("an effect")?;
            let [count, rest @ ..] = numbers.as_slice() else {
                return Err(self.error("an effect"));
            };
            let [conditions @ .., variable, before, after] = rest else {
                return Err(self.error("an effect"));
            };
            if conditions.len() as i64 != count * 2 {
                return Err(self.error("two numbers for each condition of the effect"));
            }
            let conditions = self.conditions(conditions)?;
            let variable = u32::try_from(*variable).map_err(|_| self.error("a variable"))?;
            if *before != -1 {
                precondition.push(
                    self.fact(
                        variable,
                        u32::try_from(*before).map_err(|_| self.error("a value"))?,
                    )?,
                );
            }
            let fact =
                self.fact(variable, u32::try_from(*after).map_err(|_| self.error("a value"))?)?;
            self.named.task.effect_pool.push(Effect { conditions, fact });
        }
        let cost = self.number("the cost")?;
        self.keyword("end_operator")?;
        precondition.sort_unstable();
        precondition.dedup();
        let task = &mut self.named.task;
        let first = task.precondition_pool.len() as u32;
        task.precondition_pool.extend(precondition);
        task.operators.push(Operator {
            precondition: first..task.precondition_pool.len() as u32,
            effects: first_effect..task.effect_pool.len() as u32,
            cost: if task.uses_metric { cost } else { 1 },
        });
        Ok(())
    }

    fn axiom(&mut self) -> Result<(), Error> {
        self.keyword("begin_rule")?;
        let count: usize = self.number("the number of conditions")?;
        let mut facts = self.facts(count)?;
        facts.sort_unstable();
        let numbers = self.numbers("the head")?;
        let &[variable, _, after] = numbers.as_slice() else {
            return Err(self.error("a variable and two values"));
        };
        let head = self.signed(variable, after)?;
        self.keyword("end_rule")?;
        let conditions = self.pool(facts);
        self.named.task.axioms.push(Axiom { conditions, head });
        Ok(())
    }

    /// Numbers in pairs of variable and value, as a range of the condition pool.
    fn conditions(&mut self, numbers: &[i64]) -> Result<Range<u32>, Error> {
        let mut facts = numbers
            .chunks_exact(2)
            .map(|pair| self.signed(pair[0], pair[1]))
            .collect::<Result<Vec<_>, _>>()?;
        facts.sort_unstable();
        Ok(self.pool(facts))
    }

    fn pool(&mut self, facts: Vec<Fact>) -> Range<u32> {
        let pool = &mut self.named.task.condition_pool;
        let first = pool.len() as u32;
        pool.extend(facts);
        first..pool.len() as u32
    }

    fn facts(&mut self, count: usize) -> Result<Vec<Fact>, Error> {
        (0..count)
            .map(|_| {
                let numbers = self.numbers("a variable and a value")?;
                let &[variable, value] = numbers.as_slice() else {
                    return Err(self.error("a variable and a value"));
                };
                self.signed(variable, value)
            })
            .collect()
    }

    fn signed(&self, variable: i64, value: i64) -> Result<Fact, Error> {
        match (u32::try_from(variable), u32::try_from(value)) {
            (Ok(variable), Ok(value)) => self.fact(variable, value),
            _ => Err(self.error("a variable and a value")),
        }
    }

    fn fact(&self, variable: u32, value: u32) -> Result<Fact, Error> {
        match self.named.task.variables.get(variable as usize) {
            Some(known) if value < known.domain_size => {
                Ok(Fact { variable: VariableId(variable), value })
            }
            Some(known) => Err(self.error(&format!("a value below {}", known.domain_size))),
            None => {
                Err(self.error(&format!("a variable below {}", self.named.task.variables.len())))
            }
        }
    }

    fn repeat(
        &mut self,
        what: &str,
        item: impl Fn(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        (0..self.number(what)?).try_for_each(|_: u32| item(self))
    }

    fn keyword(&mut self, keyword: &str) -> Result<(), Error> {
        if self.text(keyword)? == keyword {
            Ok(())
        } else {
            Err(self.error(&format!("`{keyword}`")))
        }
    }

    fn numbers(&mut self, what: &str) -> Result<Vec<i64>, Error> {
        let text = self.text(what)?;
        text.split_ascii_whitespace()
            .map(|word| word.parse().map_err(|_| self.error(what)))
            .collect()
    }

    fn number<N: FromStr>(&mut self, what: &str) -> Result<N, Error> {
        let text = self.text(what)?;
        text.parse().map_err(|_| self.error(what))
    }

    fn text(&mut self, what: &str) -> Result<&'t str, Error> {
        self.line += 1;
        self.lines.next().map(str::trim).ok_or_else(|| self.error(what))
    }

    fn error(&self, expected: &str) -> Error {
        Error { line: self.line, expected: expected.to_owned() }
    }
}

#[cfg(test)]
mod tests {
    use super::read;
    use crate::task::{Fact, OperatorId, VariableId};

    /// A lamp whose switch also opens a door where there is power; whoever sees the lamp lit is happy, which is derived.
    const LAMP: &str = "begin_version\n3\nend_version\nbegin_metric\n1\nend_metric\n3\n\
        begin_variable\nvar0\n-1\n2\nAtom lit(lamp)\nNegatedAtom lit(lamp)\nend_variable\n\
        begin_variable\nvar1\n-1\n3\nAtom door(open)\nAtom door(shut)\n<none of those>\nend_variable\n\
        begin_variable\nvar2\n0\n2\nAtom happy()\nNegatedAtom happy()\nend_variable\n\
        1\nbegin_mutex_group\n2\n0 0\n1 1\nend_mutex_group\n\
        begin_state\n1\n1\n1\nend_state\nbegin_goal\n1\n2 0\nend_goal\n\
        1\nbegin_operator\nswitch lamp\n1\n1 1\n2\n0 0 1 0\n1 0 1 1 -1 2\n7\nend_operator\n\
        1\nbegin_rule\n1\n0 0\n2 1 0\nend_rule\n";

    #[test]
    fn a_file_becomes_the_task_that_it_describes() {
        let named = read(LAMP).expect("the file is well formed");
        let task = &named.task;
        let fact = |variable, value| Fact { variable: VariableId(variable), value };
        let switch = OperatorId(0);
        assert_eq!(named.operators, ["switch lamp"]);
        assert_eq!(named.facts[1][2], "<none of those>");
        assert_eq!(
            (task.initial_state.as_slice(), task.goal.as_slice()),
            ([1, 1, 1].as_slice(), [fact(2, 0)].as_slice())
        );
        assert_eq!(task.precondition(switch), [fact(0, 1), fact(1, 1)]);
        assert_eq!(task.operators[0].cost, 7);
        let effects: Vec<_> = task
            .effects(switch)
            .iter()
            .map(|effect| (task.conditions(&effect.conditions), effect.fact))
            .collect();
        assert_eq!(effects, [([].as_slice(), fact(0, 0)), ([fact(0, 1)].as_slice(), fact(1, 2))]);
        assert_eq!((task.variables[2].axiom_layer, task.variables[2].default), (Some(0), 1));
        assert_eq!(
            (task.axioms[0].head, task.conditions(&task.axioms[0].conditions)),
            (fact(2, 0), [fact(0, 0)].as_slice())
        );
        assert_eq!(task.mutex_groups, [[fact(0, 0), fact(1, 1)]]);
    }

    #[test]
    fn a_wrong_file_is_refused_at_the_line_that_is_wrong() {
        let message = |text: &str| read(text).map(|_| ()).map_err(|error| error.to_string());
        assert_eq!(message(""), Err("line 1: expected begin_version".to_owned()));
        assert_eq!(
            message(&LAMP.replacen("\n3\n", "\n2\n", 1)),
            Err("line 2: expected version 3".to_owned())
        );
        assert_eq!(
            message(&LAMP.replace("2 0\nend_goal", "2 5\nend_goal")),
            Err("line 43: expected a value below 2".to_owned())
        );
        assert_eq!(
            message(&LAMP.replace("2 1 0\nend_rule", "2 1\nend_rule")),
            Err("line 59: expected a variable and two values".to_owned())
        );
    }
}
