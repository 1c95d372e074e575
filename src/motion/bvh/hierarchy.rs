//! The HIERARCHY part: joints, offsets, channels.

use glam::DVec3;

use super::scanner::{Scanner, Word, quoted};
use crate::error::{Error, Warning};
use crate::motion::{Axis, Channel, EndSite, Joint, JointId, Skeleton};

/// Reads everything up to and with the word MOTION.
pub(super) fn read(scanner: &mut Scanner, warnings: &mut Vec<Warning>) -> Result<Skeleton, Error> {
    let first = scanner.word();
    if !first.is("HIERARCHY") {
        let found = quoted(first.text);
        let message = format!("this is not a BVH file: expected \"HIERARCHY\", found {found}");
        return Err(scanner.error(first.at, message));
    }
    let mut reader =
        Reader { scanner, warnings, joints: Vec::new(), channels: 0, open: Vec::new() };
    loop {
        let word = reader.scanner.word();
        if word.is("ROOT") {
            reader.tree()?;
        } else if word.is("MOTION") && !reader.joints.is_empty() {
            return Ok(Skeleton { joints: reader.joints });
        } else {
            let expected =
                if reader.joints.is_empty() { "\"ROOT\"" } else { "\"MOTION\" or \"ROOT\"" };
            return Err(reader.scanner.expected(expected, word));
        }
    }
}

struct Reader<'s, 'a> {
    scanner: &'s mut Scanner<'a>,
    warnings: &'s mut Vec<Warning>,
    joints: Vec<Joint>,
    channels: usize,
    /// Joints whose brace is still open: a stack of its own, so that no nesting is too deep.
    open: Vec<Open>,
}

/// An open joint and what has been read of it.
struct Open {
    joint: JointId,
    at: usize,
    offset: bool,
    channels: bool,
    children: bool,
}

impl Reader<'_, '_> {
    /// One tree, from behind the word ROOT to its last brace.
    fn tree(&mut self) -> Result<(), Error> {
        self.open_joint()?;
        while let Some(open) = self.open.last() {
            let joint = open.joint;
            let word = self.scanner.word();
            if word.is("OFFSET") {
                self.claim(word, |open| &mut open.offset)?;
                self.joints[joint.0].offset = self.offset()?;
            } else if word.is("CHANNELS") {
                self.claim(word, |open| &mut open.channels)?;
                self.channels(joint)?;
            } else if word.is("JOINT") {
                self.mark_children();
                self.open_joint()?;
            } else if word.is("End") {
                self.mark_children();
                let end_site = self.end_site()?;
                self.joints[joint.0].end_sites.push(end_site);
            } else if word.is("}") {
                self.close(word)?;
            } else {
                return Err(self.unexpected(word));
            }
        }
        Ok(())
    }

    fn open_joint(&mut self) -> Result<(), Error> {
        let name = self.scanner.rest_of_line();
        let joint = JointId(self.joints.len());
        let data = Joint {
            name: self.joint_name(name, joint)?,
            parent: self.open.last().map(|open| open.joint),
            offset: DVec3::ZERO,
            channels: Vec::new(),
            first_channel: self.channels,
            end_sites: Vec::new(),
        };
        self.joints.push(data);
        self.brace()?;
        let at = name.at;
        self.open.push(Open { joint, at, offset: false, channels: false, children: false });
        Ok(())
    }

    fn joint_name(&mut self, name: Word, joint: JointId) -> Result<String, Error> {
        if !name.text.is_empty() {
            return self.text(name);
        }
        let (line, _) = self.scanner.place(name.at);
        let given = format!("joint_{}", joint.0);
        let message = format!("the joint in line {line} has no name; it is called {given}");
        self.warnings.push(Warning::new("W_NAME_MISSING", message));
        Ok(given)
    }

    fn text(&self, name: Word) -> Result<String, Error> {
        String::from_utf8(name.text.to_vec()).map_err(|_| {
            let message = "the name is not UTF-8 text; save the file as UTF-8";
            self.scanner.error(name.at, message)
        })
    }

    fn brace(&mut self) -> Result<(), Error> {
        let word = self.scanner.word();
        if word.is("{") { Ok(()) } else { Err(self.scanner.expected("\"{\"", word)) }
    }

    /// Marks a part of the open joint as read, once and before its children: the columns of the
    /// motion table follow the order of the CHANNELS lines.
    fn claim(&mut self, word: Word, part: fn(&mut Open) -> &mut bool) -> Result<(), Error> {
        let open = self.open.last_mut().expect("a joint is open inside a tree");
        let children = open.children;
        let again = std::mem::replace(part(open), true);
        if !again && !children {
            return Ok(());
        }
        let (part, joint) = (quoted(word.text), quoted(self.name(open_joint(&self.open))));
        let message = if again {
            format!("joint {joint} has {part} twice")
        } else {
            format!("{part} of joint {joint} must stand before its children")
        };
        Err(self.scanner.error(word.at, message))
    }

    fn mark_children(&mut self) {
        if let Some(open) = self.open.last_mut() {
            open.children = true;
        }
    }

    fn offset(&mut self) -> Result<DVec3, Error> {
        let (x, y, z) = (self.scanner.number()?, self.scanner.number()?, self.scanner.number()?);
        Ok(DVec3::new(x, y, z))
    }

    fn channels(&mut self, joint: JointId) -> Result<(), Error> {
        let count = self.scanner.count()?;
        self.joints[joint.0].first_channel = self.channels;
        for read in 0..count {
            let word = self.scanner.word();
            let Some(channel) = channel(word.text) else {
                let expected =
                    format!("channel name {} of {count}, such as Xposition or Zrotation", read + 1);
                return Err(self.scanner.expected(&expected, word));
            };
            self.joints[joint.0].channels.push(channel);
        }
        self.channels += count;
        Ok(())
    }

    fn end_site(&mut self) -> Result<EndSite, Error> {
        let name = self.scanner.rest_of_line();
        let name = self.text(name)?;
        self.brace()?;
        let mut offset = None;
        loop {
            let word = self.scanner.word();
            if word.is("OFFSET") && offset.is_none() {
                offset = Some(self.offset()?);
            } else if word.is("CHANNELS") {
                self.no_channels()?;
            } else if let (true, Some(offset)) = (word.is("}"), offset) {
                return Ok(EndSite { name, offset });
            } else {
                let expected = if offset.is_some() { "\"}\"" } else { "\"OFFSET\"" };
                return Err(self.scanner.expected(&format!("{expected} of the End Site"), word));
            }
        }
    }

    fn no_channels(&mut self) -> Result<(), Error> {
        let word = self.scanner.peek();
        match self.scanner.count()? {
            0 => Ok(()),
            _ => Err(self.scanner.expected("0, for an End Site has no channels", word)),
        }
    }

    fn close(&mut self, word: Word) -> Result<(), Error> {
        let open = self.open.pop().expect("a joint is open inside a tree");
        if open.offset {
            return Ok(());
        }
        let joint = quoted(self.name(open.joint));
        Err(self.scanner.error(word.at, format!("joint {joint} has no OFFSET")))
    }

    fn name(&self, joint: JointId) -> &[u8] {
        self.joints[joint.0].name.as_bytes()
    }

    fn unexpected(&self, word: Word) -> Error {
        let open = self.open.last().expect("a joint is open inside a tree");
        let joint = quoted(self.name(open.joint));
        if word.is("MOTION") || word.is("ROOT") || word.text.is_empty() {
            let (line, _) = self.scanner.place(open.at);
            let expected = format!("\"}}\" of joint {joint}, opened in line {line}");
            return self.scanner.expected(&expected, word);
        }
        if channel(word.text).is_some() {
            let message = format!(
                "joint {joint} has more channel names than its CHANNELS says, found {}",
                quoted(word.text)
            );
            return self.scanner.error(word.at, message);
        }
        let expected = "\"OFFSET\", \"CHANNELS\", \"JOINT\", \"End Site\" or \"}\"";
        self.scanner.expected(expected, word)
    }
}

fn open_joint(open: &[Open]) -> JointId {
    open.last().expect("a joint is open inside a tree").joint
}

fn channel(name: &[u8]) -> Option<Channel> {
    let (axis, kind) = name.split_first()?;
    let axis = match axis {
        b'X' | b'x' => Axis::X,
        b'Y' | b'y' => Axis::Y,
        b'Z' | b'z' => Axis::Z,
        _ => return None,
    };
    if kind.eq_ignore_ascii_case(b"position") {
        Some(Channel::Position(axis))
    } else if kind.eq_ignore_ascii_case(b"rotation") {
        Some(Channel::Rotation(axis))
    } else {
        None
    }
}
