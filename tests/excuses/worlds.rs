//! Small domains and problems for single questions about excuses.

/// Lamps that shine when they are wired and somebody switches them on.
pub const LAMPS: &str = "\
(define (domain lamps)
  (:requirements :strips :typing :negative-preconditions)
  (:types lamp)
  (:predicates (wired ?lamp - lamp) (lit ?lamp - lamp) (dusty ?lamp - lamp))
  (:action switch-on
    :parameters (?lamp - lamp)
    :precondition (wired ?lamp)
    :effect (lit ?lamp)))
";

/// Nothing wires the second lamp.
pub const DARK: &str = "\
(define (problem dark)
  (:domain lamps)
  (:objects desk hall - lamp)
  (:init (wired desk))
  (:goal (and (lit desk) (lit hall))))
";

/// A lamp at the end of two lines, each with a fuse that nobody can change.
pub const FUSES: &str = "\
(define (domain fuses)
  (:requirements :strips :typing)
  (:types fuse lamp)
  (:predicates (feeds ?fuse - fuse ?lamp - lamp) (whole ?fuse - fuse) (lit ?lamp - lamp))
  (:action switch-on
    :parameters (?fuse - fuse ?lamp - lamp)
    :precondition (and (feeds ?fuse ?lamp) (whole ?fuse))
    :effect (lit ?lamp)))
";

/// Any of three fuses would do.
pub const BLOWN: &str = "\
(define (problem blown)
  (:domain fuses)
  (:objects left middle right - fuse hall - lamp)
  (:init (feeds left hall) (feeds middle hall) (feeds right hall))
  (:goal (lit hall)))
";

/// A domain with an axiom: what is wired to something live is live.
pub const GRID: &str = "\
(define (domain grid)
  (:requirements :strips :derived-predicates)
  (:predicates (wire ?from ?to) (source ?node) (live ?node) (shining ?node))
  (:derived (live ?node) (or (source ?node) (exists (?from) (and (wire ?from ?node) (live ?from)))))
  (:action light
    :parameters (?node)
    :precondition (live ?node)
    :effect (shining ?node)))
";

/// No wire leads to the lamp.
pub const MAST: &str = "\
(define (problem mast)
  (:domain grid)
  (:objects plant mast lamp)
  (:init (source plant) (wire plant mast))
  (:goal (shining lamp)))
";

/// A ferry that has never learnt how to sail.
pub const FERRY: &str = "\
(define (domain ferry)
  (:requirements :strips :typing)
  (:types car landing)
  (:predicates
    (ferry-at ?landing - landing)
    (waits-at ?car - car ?landing - landing)
    (aboard ?car - car)
    (deck-free))
  (:action drive-on
    :parameters (?car - car ?landing - landing)
    :precondition (and (ferry-at ?landing) (waits-at ?car ?landing) (deck-free))
    :effect (and (aboard ?car) (not (waits-at ?car ?landing)) (not (deck-free))))
  (:action drive-off
    :parameters (?car - car ?landing - landing)
    :precondition (and (ferry-at ?landing) (aboard ?car))
    :effect (and (waits-at ?car ?landing) (deck-free) (not (aboard ?car)))))
";

/// One car shall cross.
pub const CROSSING: &str = "\
(define (problem crossing)
  (:domain ferry)
  (:objects red - car north south east - landing)
  (:init (ferry-at east) (waits-at red north) (deck-free))
  (:goal (waits-at red south)))
";

/// Boxes that nobody opens. That `open` and `closed` exclude each other is in their names.
pub const BOXES: &str = "\
(define (domain boxes)
  (:requirements :strips :typing)
  (:types box item)
  (:predicates
    (open ?box - box)
    (closed ?box - box)
    (held ?item - item)
    (in ?item - item ?box - box))
  (:action put
    :parameters (?item - item ?box - box)
    :precondition (and (held ?item) (open ?box))
    :effect (and (in ?item ?box) (not (held ?item)))))
";

/// The only box is closed.
pub const BOX: &str = "\
(define (problem one-box)
  (:domain boxes)
  (:objects small - box cup - item)
  (:init (closed small) (held cup))
  (:goal (in cup small)))
";

/// A robot that paints the room it is in.
pub const PAINTER: &str = "\
(define (domain painter)
  (:requirements :strips :typing)
  (:types room)
  (:predicates (robot-in ?room - room) (door ?from ?to - room) (painted ?room - room))
  (:action go
    :parameters (?from ?to - room)
    :precondition (and (robot-in ?from) (door ?from ?to))
    :effect (and (robot-in ?to) (not (robot-in ?from))))
  (:action paint
    :parameters (?room - room)
    :precondition (robot-in ?room)
    :effect (painted ?room)))
";

/// Nothing is said about where the robot is.
pub const NOWHERE: &str = "\
(define (problem nowhere)
  (:domain painter)
  (:objects cellar hall attic - room)
  (:init (door cellar hall) (door hall attic) (door attic hall))
  (:goal (painted attic)))
";
