//! Bytes in the Common Data Representation of DDS go in; numbers, texts and poses of ROS 2 messages come out.
//!
//! Only what is needed is here: plain CDR, version 1, of either byte order (OMG DDSI-RTPS 2.5, section 10.2).

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::fault::Fault;

/// Reads one message from its start.
pub(super) struct Message<'a> {
    bytes: &'a [u8],
    at: usize,
    little: bool,
}

/// The head of a stamped message.
pub(super) struct Stamp {
    /// The time in nanoseconds; 0 where nobody set it.
    pub time: u64,
    /// The frame in which the rest is given.
    pub frame: String,
}

/// What is wrong with a message that ends too soon or is not what its type says.
fn cut() -> Fault {
    Fault::Form(String::from("the message is shorter than its type"))
}

impl<'a> Message<'a> {
    /// The message after its four bytes about itself.
    pub fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        match bytes {
            [0, order @ (0 | 1), _, _, rest @ ..] => {
                Ok(Self { bytes: rest, at: 0, little: *order == 1 })
            }
            [_, _, _, _, ..] => Err(Fault::Form(String::from("the message is not plain CDR"))),
            _ => Err(cut()),
        }
    }

    /// The next so many bytes, which begin at a multiple of their number.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        self.at = self.at.next_multiple_of(N);
        let bytes = self.bytes.get(self.at..self.at + N).ok_or_else(cut)?;
        self.at += N;
        let mut array: [u8; N] = bytes.try_into().map_err(|_| cut())?;
        if !self.little {
            array.reverse();
        }
        Ok(array)
    }

    /// A number of four bytes.
    pub fn unsigned(&mut self) -> Result<u32, Fault> {
        self.take().map(u32::from_le_bytes)
    }

    /// A real number of four bytes.
    pub fn single(&mut self) -> Result<f64, Fault> {
        self.take().map(f32::from_le_bytes).map(f64::from)
    }

    /// A real number of eight bytes.
    pub fn double(&mut self) -> Result<f64, Fault> {
        self.take().map(f64::from_le_bytes)
    }

    /// A truth value.
    pub fn truth(&mut self) -> Result<bool, Fault> {
        self.take::<1>().map(|[byte]| byte != 0)
    }

    /// A text, which ends with a zero byte.
    pub fn text(&mut self) -> Result<String, Fault> {
        let length = self.unsigned()? as usize;
        let end = self.at.checked_add(length).ok_or_else(cut)?;
        let bytes = self.bytes.get(self.at..end).ok_or_else(cut)?;
        self.at = end;
        let bytes = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    /// The number of items of a sequence, which cannot be more than there are bytes.
    pub fn count(&mut self) -> Result<usize, Fault> {
        let count = self.unsigned()? as usize;
        if count > self.bytes.len() - self.at { Err(cut()) } else { Ok(count) }
    }

    /// `std_msgs/Header`.
    pub fn stamp(&mut self) -> Result<Stamp, Fault> {
        let seconds = self.unsigned()?;
        let nanoseconds = self.unsigned()?;
        let frame = self.text()?;
        Ok(Stamp { time: u64::from(seconds) * 1_000_000_000 + u64::from(nanoseconds), frame })
    }

    /// `geometry_msgs/Pose` or `Transform`: seven numbers of eight bytes.
    pub fn pose(&mut self) -> Result<Isometry3<f64>, Fault> {
        let mut values = [0.0; 7];
        for value in &mut values {
            *value = self.double()?;
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(Fault::NotFinite);
        }
        let turn = Quaternion::new(values[6], values[3], values[4], values[5]);
        if (turn.norm() - 1.0).abs() > 0.02 {
            return Err(Fault::Quaternion(turn.norm()));
        }
        let place = Translation3::new(values[0], values[1], values[2]);
        Ok(Isometry3::from_parts(place, UnitQuaternion::new_normalize(turn)))
    }
}
