//! Scripts in which hands go from spot to spot go in; the moves that keep shared spots free come out, as listing 3.1 of the thesis has them.

use lang::model::{ActionId, Domain};
use lang::write::Style;
use learner::moves::{Constrained, constrain};
use learner::operators::Options;
use learner::write;

use super::words::{options, taught, warnings};

const ARMS: &str = "things tray home - spot
    holds (at left home) (reachable tray left) (reachable tray right) (reachable home left)
    1.0 - (at left home) left 0
    1.6 + (at left tray) left 0
    4.0 - (at left tray) left 0
    4.6 + (at left home) left 0
    6.0 + (at right tray) right 0
    8.0 - (at right tray) right 0";

/// The domain of the script with and without constrained moves.
fn constrained() -> (Domain, Domain, Style, Constrained) {
    let taught = taught(&[ARMS], &Options { agents: true, ..options() });
    let (plain, mut style) = write::domain(&taught.learned, taught.learned.rule);
    let mut domain = plain.clone();
    let made = constrain(&mut domain, &mut style, "at", "reachable");
    (plain, domain, style, made)
}

#[test]
fn each_move_to_a_spot_gets_two_for_spots_that_others_reach() {
    let (_, domain, style, made) = constrained();
    let text = lang::write::domain(&domain, &style);
    insta::with_settings!({ description => ARMS, omit_expression => true }, {
        insta::assert_snapshot!("constrained moves", text);
    });
    let made: Vec<(&str, &str, bool)> =
        made.iter().map(|(new, old, follows)| (new.as_str(), old.as_str(), *follows)).collect();
    assert_eq!(
        made,
        [
            ("constrained-move-1", "move", false),
            ("constrained-move-2", "move", true),
            ("constrained-enter-1", "enter", false),
            ("constrained-enter-2", "enter", true),
        ]
    );
    assert_eq!(warnings(&text), [""; 0]);
}

#[test]
fn what_moves_nobody_stays_as_it_is() {
    let (plain, domain, _, _) = constrained();
    let leave = |domain: &Domain| {
        let place = domain.actions.iter().position(|one| one.name.text == "leave");
        let id = ActionId(place.expect("it is there") as u32);
        lang::write::action(domain, id, &Style::default())
    };
    assert_eq!(leave(&plain), leave(&domain));
}

#[test]
fn without_words_for_places_nothing_is_changed() {
    let (plain, _, mut style, _) = constrained();
    let mut domain = plain.clone();
    assert_eq!(constrain(&mut domain, &mut style, "place", "reachable"), []);
    assert_eq!(domain.actions.len(), plain.actions.len());
}
