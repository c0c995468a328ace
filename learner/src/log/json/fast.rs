//! A line of JSON as this program writes it goes in; its frame comes out, or nothing where anything is unusual.
//!
//! Nine tenths of the time of reading with serde go into numbers and into asking what comes next. Here that is known:
//! the fields in their order without spaces, bodies in the order of the header, numbers without exponents.
//! Whatever else a line has, or is wrong with it, is left to [`frame`](super::frame), so this never decides that a line is bad.

use super::super::header::Scale;
use super::super::{Frame, HandSample, Header, ObjectSample, sample};

/// The frame of a line, if it is in the usual form and nothing is wrong with it.
pub(super) fn read(
    line: &[u8],
    header: &Header,
    scale: Scale,
    before: Option<f64>,
) -> Option<Frame> {
    let mut cursor = Cursor { rest: line };
    cursor.skip(b"{\"t\":")?;
    let time = sample::time(cursor.number()?, scale, before).ok()?;
    cursor.skip(b",\"hands\":{")?;
    let mut hands = Vec::with_capacity(header.hands.len());
    for hand in &header.hands {
        let found = cursor.key(&hand.name, hands.iter().all(Option::is_none))?;
        hands.push(if found { Some(cursor.hand(scale)?) } else { None });
    }
    cursor.skip(b"},\"objects\":{")?;
    let mut objects = Vec::with_capacity(header.objects.len());
    let mut first = true;
    for object in &header.objects {
        let found = cursor.key(&object.name, first)?;
        first &= !found;
        objects.push(if found {
            let mut body = cursor.object(scale)?;
            if !body.joints.is_empty() {
                sample::joints(&mut body.joints, object, scale).ok()?;
            }
            Some(body)
        } else {
            None
        });
    }
    cursor.skip(b"}}")?;
    cursor.rest.is_empty().then_some(Frame { time, hands, objects, facts: None })
}

/// What of a line is not read yet.
struct Cursor<'a> {
    rest: &'a [u8],
}

impl Cursor<'_> {
    /// Passes over what must come next.
    fn skip(&mut self, text: &[u8]) -> Option<()> {
        self.rest = self.rest.strip_prefix(text)?;
        Some(())
    }

    /// Whether the next entry is of this name; passes over its key then. None where a name needs escapes.
    fn key(&mut self, name: &str, first: bool) -> Option<bool> {
        if name.bytes().any(|byte| byte == b'\\' || byte < b' ') {
            return None;
        }
        let start: &[u8] = if first { b"\"" } else { b",\"" };
        let rest = self.rest.strip_prefix(start);
        let rest = rest.and_then(|rest| rest.strip_prefix(name.as_bytes()));
        let rest = rest.and_then(|rest| rest.strip_prefix(b"\":"));
        if let Some(rest) = rest {
            self.rest = rest;
        }
        Some(rest.is_some())
    }

    /// A hand: a pose, or a pose with a grip.
    fn hand(&mut self, scale: Scale) -> Option<HandSample> {
        if self.rest.first() == Some(&b'[') {
            return Some(HandSample {
                pose: self.pose(scale)?,
                grip: None,
                teach: false,
                given: None,
            });
        }
        self.skip(b"{\"pose\":")?;
        let pose = self.pose(scale)?;
        let mut grip = None;
        if self.skip(b",\"grip\":").is_some() {
            grip = Some(sample::share(self.number()?).ok()?);
        }
        let teach = self.skip(b",\"teach\":true").is_some();
        self.skip(b"}")?;
        Some(HandSample { pose, grip, teach, given: None })
    }

    /// An object: a pose, or a pose with joints and how sure it is.
    fn object(&mut self, scale: Scale) -> Option<ObjectSample> {
        if self.rest.first() == Some(&b'[') {
            return Some(ObjectSample { pose: self.pose(scale)?, joints: Vec::new(), seen: 1.0 });
        }
        self.skip(b"{\"pose\":")?;
        let pose = self.pose(scale)?;
        let mut joints = Vec::new();
        if self.skip(b",\"joints\":[").is_some() {
            loop {
                joints.push(self.number()?);
                if self.skip(b"]").is_some() {
                    break;
                }
                self.skip(b",")?;
            }
        }
        let mut seen = 1.0;
        if self.skip(b",\"seen\":").is_some() {
            seen = sample::share(self.number()?).ok()?;
        }
        self.skip(b"}")?;
        Some(ObjectSample { pose, joints, seen })
    }

    /// Seven numbers in brackets.
    fn pose(&mut self, scale: Scale) -> Option<nalgebra::Isometry3<f64>> {
        let mut values = [0.0; 7];
        self.skip(b"[")?;
        for (place, value) in values.iter_mut().enumerate() {
            if place > 0 {
                self.skip(b",")?;
            }
            *value = self.number()?;
        }
        self.skip(b"]")?;
        sample::pose(values, scale).ok()
    }

    /// A number of at most fifteen digits without an exponent.
    ///
    /// Such an integer and such a power of ten are exact as floating-point numbers, so their quotient is the nearest one to what is written.
    fn number(&mut self) -> Option<f64> {
        let bytes = self.rest;
        let negative = bytes.first() == Some(&b'-');
        let start = usize::from(negative);
        let mut at = start;
        let mut value = 0u64;
        let mut digits = |at: &mut usize| {
            let from = *at;
            while let Some(digit) =
                bytes.get(*at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10)
            {
                value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
                *at += 1;
            }
            *at - from
        };
        let whole = digits(&mut at);
        let mut after = 0;
        if bytes.get(at) == Some(&b'.') {
            at += 1;
            after = digits(&mut at);
            if after == 0 {
                return None;
            }
        }
        // JSON has neither numbers without digits before the point nor zeros that lead others.
        let leading = whole > 1 && bytes[start] == b'0';
        if whole == 0 || leading || whole + after > 15 || matches!(bytes.get(at), Some(b'e' | b'E'))
        {
            return None;
        }
        self.rest = &bytes[at..];
        let value = value as f64 / POWERS[after];
        Some(if negative { -value } else { value })
    }
}

/// Powers of ten.
const POWERS: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::super::header;
    use super::super::frame::{self, Index};
    use super::*;

    const HEADER: &str = r#"{"caveat-log":1,"units":{"length":"mm"},"agents":[{"name":"p","hands":[{"name":"left"},{"name":"right"}]}],"objects":[{"name":"a","type":"x","size":[1,1,1]},{"name":"b","type":"x","size":[1,1,1],"joints":[{"name":"j","motion":"slides","axis":[1,0,0],"lower":0,"upper":1}]}]}"#;

    /// What both ways of reading make of a line.
    fn both(line: &str) -> (Option<Frame>, Option<Frame>) {
        let (header, scale) = header::read(HEADER.as_bytes(), 1).expect("the header is good");
        let mut index = Index::new(&header);
        let slow = frame::read(line.as_bytes(), &header, &mut index, scale, Some(1.0)).ok();
        (read(line.as_bytes(), &header, scale, Some(1.0)), slow)
    }

    #[test]
    fn the_usual_form_is_read_fast_and_nothing_else() {
        let fast = [
            r#"{"t":2,"hands":{},"objects":{}}"#,
            r#"{"t":2.5,"hands":{"left":[0,0,0,0,0,0,1],"right":{"pose":[-1.25,0.5,3,0,0,0,1],"grip":0.5,"teach":true}},"objects":{"b":{"pose":[0,0,0,0,0,0.6,0.8],"joints":[0.5],"seen":0.25}}}"#,
            r#"{"t":2,"hands":{"right":[0,0,0,0,0,0,1]},"objects":{"a":[0,0,0,0,0,0,1],"b":[0,0,0,0,0,0,1]}}"#,
        ];
        for line in fast {
            let (fast, slow) = both(line);
            assert!(fast.is_some(), "{line}");
            assert_eq!(fast, slow, "{line}");
        }
        let left = [
            r#"{"t":2,"hands":{"right":[0,0,0,0,0,0,1],"left":[0,0,0,0,0,0,1]},"objects":{}}"#,
            r#"{"t":2e0,"hands":{},"objects":{}}"#,
            r#"{"t": 2,"hands":{},"objects":{}}"#,
            r#"{"t":2,"hands":{},"objects":{},"facts":[]}"#,
            r#"{"t":2,"hands":{},"objects":{"a":null}}"#,
        ];
        for line in left {
            let (fast, slow) = both(line);
            assert!(fast.is_none() && slow.is_some(), "{line}");
        }
    }

    proptest! {
        /// What is read fast is read the same slowly, and in particular never read at all if it is bad.
        #[test]
        fn fast_reading_is_never_wrong(
            line in r#"\{"t":(0|-?[0-9]{1,3}(\.[0-9]{0,4})?),"hands":\{("left":\[0,0,0,0,0,0,[01](\.0)?\])?,?("right":\{"pose":\[-?[0-9]{1,2}\.[0-9]{1,14},0?,0,0,0,0,1\](,"grip":[0-9](\.[0-9])?)?\})?\},"objects":\{("a":\[0,00?,0,0,0,0,1\])?\}\}?"#
        ) {
            let (fast, slow) = both(&line);
            prop_assert!(fast.is_none() || fast == slow, "{line}: {fast:?} {slow:?}");
        }

        #[test]
        fn numbers_are_the_nearest_ones(text in "-?(0|[1-9][0-9]{0,6})(\\.[0-9]{1,8})?") {
            let mut cursor = Cursor { rest: text.as_bytes() };
            let value = cursor.number().expect("it is a number");
            prop_assert_eq!(value.to_bits(), text.parse::<f64>().expect("it is a number").to_bits());
            prop_assert!(cursor.rest.is_empty());
        }
    }
}
