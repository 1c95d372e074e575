//! The skeleton (骨格): joints as the file lists them, parents before children.

use glam::DVec3;

use crate::motion::Axis;

/// The index of a joint in the file, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointId(pub usize);

/// Target of one column of the motion table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// Position along an axis, in the file's unit. It *replaces* the offset on that axis.
    Position(Axis),
    /// Rotation about an axis, in degrees. A joint's rotations are multiplied in the order listed.
    Rotation(Axis),
}

/// The tip of a bone that has no joint of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct EndSite {
    /// The word after `End`, usually `Site`.
    pub name: String,
    /// Vector from the joint to the tip, in the file's unit.
    pub offset: DVec3,
}

/// A joint (関節) and the bone that leads to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The name as written.
    pub name: String,
    /// Parent joint; `None` for a root.
    pub parent: Option<JointId>,
    /// Vector from the parent at rest, in the file's unit.
    pub offset: DVec3,
    /// Channels of the joint, in the order listed.
    pub channels: Vec<Channel>,
    /// Column of its first channel in a row of the motion table.
    pub first_channel: usize,
    /// Tips of bones that end at this joint.
    pub end_sites: Vec<EndSite>,
}

impl Joint {
    /// Whether the joint can turn. Otherwise it is a point on the bone of the joint before it.
    pub(crate) fn turns(&self) -> bool {
        self.channels.iter().any(|channel| matches!(channel, Channel::Rotation(_)))
    }
}

/// Joints in file order: a parent always comes before its children.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Skeleton {
    /// The joints.
    pub joints: Vec<Joint>,
}

impl Skeleton {
    /// Number of joints.
    pub fn len(&self) -> usize {
        self.joints.len()
    }

    /// Whether the skeleton is empty.
    pub fn is_empty(&self) -> bool {
        self.joints.is_empty()
    }

    /// Number of columns in a row of the motion table.
    pub fn channels(&self) -> usize {
        self.joints.iter().map(|joint| joint.channels.len()).sum()
    }

    /// Returns the joints with their ids, parents first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (JointId, &Joint)> {
        self.joints.iter().enumerate().map(|(joint, data)| (JointId(joint), data))
    }

    /// Finds the first joint with that name.
    pub fn find(&self, name: &str) -> Option<JointId> {
        self.joints.iter().position(|joint| joint.name == name).map(JointId)
    }

    /// Returns the root of each joint's tree.
    pub(crate) fn roots(&self) -> Vec<usize> {
        let mut roots = Vec::with_capacity(self.len());
        for (joint, data) in self.iter() {
            roots.push(data.parent.map_or(joint.0, |parent| roots[parent.0]));
        }
        roots
    }

    /// Returns the joint of each point of a pose: first the joints themselves, then the joint of each tip.
    pub fn owners(&self) -> impl Iterator<Item = usize> {
        let tips =
            self.iter().flat_map(|(joint, data)| data.end_sites.iter().map(move |_| joint.0));
        (0..self.len()).chain(tips)
    }

    /// Finds the joints that have children.
    pub(crate) fn carriers(&self) -> Vec<bool> {
        let mut carries = vec![false; self.len()];
        let parents = self.joints.iter().filter_map(|joint| joint.parent);
        parents.for_each(|parent| carries[parent.0] = true);
        carries
    }

    /// Computes the reach of each joint: the length of the longest chain of bones below it, End Sites included, in
    /// the file's unit. A leaf without an End Site gets its own bone's length.
    ///
    /// Returns one value per joint, in joint order.
    pub fn reaches(&self) -> Vec<f64> {
        let mut reaches = vec![0.0; self.len()];
        for (JointId(joint), data) in self.iter().rev() {
            let tips = data.end_sites.iter().map(|end| end.offset.length());
            let chain = tips.fold(reaches[joint], f64::max);
            // A leaf without an End Site drives nothing named in the file: its own bone's length stands in for the
            // missing tip.
            reaches[joint] = if chain > 0.0 { chain } else { data.offset.length() };
            if let Some(JointId(parent)) = data.parent {
                let through = data.offset.length() + if chain > 0.0 { chain } else { 0.0 };
                reaches[parent] = f64::max(reaches[parent], through);
            }
        }
        reaches
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(name: &str, parent: Option<usize>, length: f64) -> Joint {
        Joint {
            name: name.into(),
            parent: parent.map(JointId),
            offset: DVec3::new(0.0, length, 0.0),
            channels: vec![],
            first_channel: 0,
            end_sites: vec![],
        }
    }

    #[test]
    fn a_reach_is_the_longest_chain_below() {
        let mut skeleton = Skeleton {
            joints: vec![
                joint("hips", None, 0.0),
                joint("spine", Some(0), 2.0),
                joint("head", Some(1), 3.0),
                joint("leg", Some(0), 4.0),
            ],
        };
        assert_eq!(skeleton.reaches(), [5.0, 3.0, 3.0, 4.0], "bare leaves take their own bone");
        let tip = EndSite { name: "Site".into(), offset: DVec3::X };
        skeleton.joints[2].end_sites.push(tip);
        assert_eq!(skeleton.reaches(), [6.0, 4.0, 1.0, 4.0], "an End Site is part of the chain");
    }
}
