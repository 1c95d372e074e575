//! Reads the HIERARCHY section: joints, offsets and channels.

use glam::DVec3;

use super::columns::{Columns, channel, is_like_a_channel};
use super::scanner::{Scanner, Word, quoted};
use super::warnings::{
    AXIS_TWICE, CHANNEL_COUNT, CHANNEL_UNKNOWN, END_SITE_CHANNELS, NAME_MISSING,
};
use crate::error::Error;
use crate::motion::{Channel, EndSite, Joint, JointId, Skeleton};

/// The contents of the HIERARCHY section.
pub(super) struct Head {
    pub(super) skeleton: Skeleton,
    /// Columns of the motion table.
    pub(super) columns: Columns,
    /// Byte offset of each joint's name.
    pub(super) names_at: Vec<usize>,
}

/// Reads everything up to and including the word MOTION.
pub(super) fn read(scanner: &mut Scanner) -> Result<Head, Error> {
    let first = scanner.word();
    if !first.is("HIERARCHY") {
        let found = quoted(first.text);
        let message = format!("this is not a BVH file: expected \"HIERARCHY\", found {found}");
        return Err(scanner.error(first.at, message));
    }
    let mut reader = Reader {
        scanner,
        joints: Vec::new(),
        names_at: Vec::new(),
        channels: 0,
        columns: Columns::default(),
        open: Vec::new(),
    };
    loop {
        let word = reader.scanner.word();
        if word.is("ROOT") {
            reader.tree()?;
        } else if word.is("MOTION") && !reader.joints.is_empty() {
            let Reader { joints, columns, names_at, .. } = reader;
            return Ok(Head { skeleton: Skeleton { joints }, columns, names_at });
        } else {
            let expected =
                if reader.joints.is_empty() { "\"ROOT\"" } else { "\"MOTION\" or \"ROOT\"" };
            return Err(reader.scanner.expected(expected, word));
        }
    }
}

struct Reader<'s, 'a> {
    scanner: &'s mut Scanner<'a>,
    joints: Vec<Joint>,
    names_at: Vec<usize>,
    /// Number of channels of all joints so far.
    channels: usize,
    columns: Columns,
    /// Joints whose brace is still open. An explicit stack, so that deep nesting cannot overflow the call
    /// stack.
    open: Vec<Open>,
}

/// An open joint and the parts of it read so far.
struct Open {
    joint: JointId,
    at: usize,
    offset: bool,
    channels: bool,
    children: bool,
}

impl Reader<'_, '_> {
    /// Reads one tree, from behind the word ROOT to its last brace.
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
            name: self.joint_name(name, joint),
            parent: self.open.last().map(|open| open.joint),
            offset: DVec3::ZERO,
            channels: Vec::new(),
            first_channel: self.channels,
            end_sites: Vec::new(),
        };
        self.joints.push(data);
        self.names_at.push(name.at);
        self.brace()?;
        let at = name.at;
        self.open.push(Open { joint, at, offset: false, channels: false, children: false });
        Ok(())
    }

    fn joint_name(&mut self, name: Word, joint: JointId) -> String {
        if !name.text.is_empty() {
            return text(name);
        }
        let given = format!("joint_{}", joint.0);
        let message = || format!("a joint has no name; it is called {given}");
        self.scanner.notices.add(NAME_MISSING, name.at, message);
        given
    }

    fn brace(&mut self) -> Result<(), Error> {
        let word = self.scanner.word();
        if word.is("{") { Ok(()) } else { Err(self.scanner.expected("\"{\"", word)) }
    }

    /// Marks a part of the open joint as read. Each part may appear once, before the joint's children,
    /// because the columns of the motion table follow the order of the CHANNELS lines.
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
        let channels = self.channel_list(Some(joint))?;
        let data = &mut self.joints[joint.0];
        data.first_channel = self.channels;
        self.channels += channels.len();
        data.channels = channels;
        Ok(())
    }

    /// Reads a channel list, from behind CHANNELS. Every name is a column of the table, whatever count the
    /// file declares. Columns of an End Site and of unknown channels are skipped.
    fn channel_list(&mut self, joint: Option<JointId>) -> Result<Vec<Channel>, Error> {
        let at = self.scanner.peek().at;
        let said = self.scanner.count()?;
        let (mut names, mut channels, mut seen) = (0, Vec::new(), Vec::with_capacity(6));
        loop {
            let word = self.scanner.peek();
            if !is_like_a_channel(word.text) && (names == said || !is_a_name(word)) {
                break;
            }
            self.scanner.word();
            names += 1;
            let channel = channel(word.text).filter(|_| joint.is_some());
            self.columns.push(channel.is_some());
            let Some(joint) = joint else { continue };
            let name = || quoted(self.joints[joint.0].name.as_bytes());
            let Some(channel) = channel else {
                let message = || {
                    let word = quoted(word.text);
                    format!("joint {} has a channel {word}; its column is left out", name())
                };
                self.scanner.notices.add(CHANNEL_UNKNOWN, word.at, message);
                continue;
            };
            channels.push(channel);
            if !seen.contains(&channel) {
                seen.push(channel);
                continue;
            }
            let message = || format!("joint {} has {} twice", name(), quoted(word.text));
            self.scanner.notices.add(AXIS_TWICE, word.at, message);
        }
        if names != said {
            let message = || format!("{said} channels are said to come and {names} do");
            self.scanner.notices.add(CHANNEL_COUNT, at, message);
        }
        Ok(channels)
    }

    fn end_site(&mut self) -> Result<EndSite, Error> {
        let name = self.scanner.rest_of_line();
        let name = text(name);
        self.brace()?;
        let mut offset = None;
        loop {
            let word = self.scanner.word();
            if word.is("OFFSET") && offset.is_none() {
                offset = Some(self.offset()?);
            } else if word.is("CHANNELS") {
                self.end_site_channels()?;
            } else if let (true, Some(offset)) = (word.is("}"), offset) {
                return Ok(EndSite { name, offset });
            } else {
                let expected = if offset.is_some() { "\"}\"" } else { "\"OFFSET\"" };
                return Err(self.scanner.expected(&format!("{expected} of the End Site"), word));
            }
        }
    }

    fn end_site_channels(&mut self) -> Result<(), Error> {
        let (at, before) = (self.scanner.peek().at, self.columns.width());
        self.channel_list(None)?;
        if self.columns.width() > before {
            let message = || "an End Site has channels; their columns are left out".into();
            self.scanner.notices.add(END_SITE_CHANNELS, at, message);
        }
        Ok(())
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
        let expected = "\"OFFSET\", \"CHANNELS\", \"JOINT\", \"End Site\" or \"}\"";
        self.scanner.expected(expected, word)
    }
}

fn open_joint(open: &[Open]) -> JointId {
    open.last().expect("a joint is open inside a tree").joint
}

/// Converts a name to a string. The text is UTF-8 up to the word MOTION.
fn text(name: Word) -> String {
    String::from_utf8_lossy(name.text).into_owned()
}

/// Whether a word may be a name: not a number, a brace or a keyword.
fn is_a_name(word: Word) -> bool {
    let keywords = ["ROOT", "JOINT", "End", "OFFSET", "CHANNELS", "MOTION"];
    let begins = |byte: &u8| byte.is_ascii_alphabetic() || *byte == b'_' || !byte.is_ascii();
    word.text.first().is_some_and(begins) && !keywords.iter().any(|keyword| word.is(keyword))
}
