//! The name of a world, a person and a seed go in; a demonstration comes out that physics has carried out, or a plan is carried out and judged from where things end up.
//!
//! The rooms in the order in which data passes them:
//!
//! - `space`: poses for the physics engine and back;
//! - `thing`: furniture by its measures;
//! - `stage`, `screw`: the physical world with its hands, and the thread of a lid;
//! - `motion`: the ways of hands;
//! - [`Person`]: who demonstrates;
//! - `cubes`, `kitchen`, `bottle`, `hanoi`, [`Scenario`]: the worlds and what is done in them;
//! - `skill`, `actor`: what hands can do, as movements;
//! - `facts`, `witness`: what holds, and what really happens;
//! - `tracker`: what a noisy tracker logs of it;
//! - [`demonstrate`](demonstrate()): all of that in a row; [`draw`]: a log as a picture;
//! - [`execute`](execute()): a plan carried out by way points, and judged.
//!
//! Nothing teleports: hands are kinematic bodies with bounded speed, and what they hold follows by a joint of bounded force.
//!
//! ```
//! use domains::world::{Person, Scenario, Task, demonstrate};
//!
//! let shown = demonstrate(Scenario::Cubes, Task::StackOne, &Person::draw(7, 1), 1);
//! assert!(shown.reached);
//! assert_eq!(shown.frames.len(), shown.truths.len());
//! ```

mod actor;
mod bottle;
mod cubes;
mod demonstrate;
mod execute;
mod facts;
mod hanoi;
mod kitchen;
mod motion;
mod person;
mod picture;
mod scenario;
mod screw;
mod skill;
mod space;
mod stage;
mod thing;
mod tracker;
mod witness;

pub use demonstrate::{Demonstration, demonstrate};
pub use execute::{Outcome, PlanStep, execute, holds_at_start};
pub use motion::{GREATEST_ACCELERATION, GREATEST_SPEED, GREATEST_TURN};
pub use person::{HELD_OUT, Person, Side};
pub use picture::draw;
pub use scenario::{Goal, Scenario, Task};
pub use tracker::RATE;
