//! Chooses which take of a file to read.

use genga::error::{Error, Warning, did_you_mean};

/// Warning that a file has several takes and the user named none.
pub const TAKES: &str = "W_TAKES";

/// A take (テイク): one motion of several that a file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Take {
    /// Its name in the file.
    pub name: String,
    /// Its duration.
    pub seconds: f64,
    /// Whether a joint moves in it.
    pub moves: bool,
}

/// Most names listed in a sentence.
const MOST: usize = 12;

/// Separator that some programs put between the armature and the name of its take: `Armature|Walk`.
const OF: char = '|';

/// Chooses the take to read: the requested one, else the first in which a joint moves. Warns if there are
/// several and none was requested. Returns `None` if the file has no takes.
///
/// # Errors
/// [`Error::Setting`] that lists the takes, if the requested one does not exist.
pub(super) fn choose(
    asked: Option<&str>,
    takes: &[Take],
) -> Result<Option<(usize, Option<Warning>)>, Error> {
    check(asked, takes)?;
    if let Some(name) = asked {
        return Ok(find(name, takes).map(|at| (at, None)));
    }
    let Some(at) = takes.iter().position(|take| take.moves).or((!takes.is_empty()).then_some(0))
    else {
        return Ok(None);
    };
    let warning = (takes.len() > 1).then(|| {
        let message = format!(
            "the file has {} takes, {}; {} is read, --take NAME reads another",
            takes.len(),
            listed(takes),
            takes[at].name
        );
        Warning::new(TAKES, message)
    });
    Ok(Some((at, warning)))
}

/// Finds the take with that name, or the only one with that name behind its armature.
fn find(name: &str, takes: &[Take]) -> Option<usize> {
    let is_behind = |take: &Take| take.name.rsplit_once(OF).is_some_and(|(_, own)| own == name);
    let mut behind = takes.iter().enumerate().filter(|(_, take)| is_behind(take));
    let only = behind.next().filter(|_| behind.next().is_none());
    takes.iter().position(|take| take.name == name).or(only.map(|(at, _)| at))
}

/// Rejects a requested take that does not exist.
pub(super) fn check(asked: Option<&str>, takes: &[Take]) -> Result<(), Error> {
    let Some(name) = asked.filter(|name| find(name, takes).is_none()) else {
        return Ok(());
    };
    let message = match takes {
        [] => format!("there is no take {name:?}: the file has one motion, without a name"),
        takes => {
            let others = takes.iter().filter(|_| takes.len() > 1);
            let tip = did_you_mean(name, others.map(|take| take.name.as_str()));
            format!("there is no take {name:?}; there is {}{tip}", listed(takes))
        }
    };
    Err(Error::setting("take", message))
}

fn listed(takes: &[Take]) -> String {
    let mut names: Vec<&str> = takes.iter().take(MOST).map(|take| take.name.as_str()).collect();
    if takes.len() > MOST {
        names.push("…");
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(name: &str, moves: bool) -> Take {
        Take { name: name.into(), seconds: 1.0, moves }
    }

    #[test]
    fn the_first_take_that_moves_is_read_and_the_others_are_told() {
        let all = [take("Bind", false), take("Walk", true), take("Run", true)];
        let (at, warning) = choose(None, &all).unwrap().unwrap();
        let warning = warning.unwrap().to_string();
        assert_eq!(at, 1);
        assert_eq!(
            warning,
            "the file has 3 takes, Bind, Walk, Run; Walk is read, --take NAME reads another [W_TAKES]"
        );
        assert_eq!(choose(Some("Run"), &all).unwrap(), Some((2, None)));
        assert_eq!(choose(None, &all[..1]).unwrap(), Some((0, None)));
        assert_eq!(choose(None, &[]).unwrap(), None);
        let error = choose(Some("Rum"), &all).unwrap_err().to_string();
        assert!(error.ends_with("there is Bind, Walk, Run; did you mean Run?"), "{error}");
        let error = choose(Some("Pitching"), &all).unwrap_err().to_string();
        assert!(error.ends_with("there is Bind, Walk, Run"), "{error}");
    }

    #[test]
    fn a_take_is_found_without_its_armature_where_only_one_is_called_so() {
        let all = [take("Rig|Walk", true), take("Rig|Run", true), take("Cape|Run", true)];
        let found = |name| choose(Some(name), &all).map(|found| found.map(|(at, _)| at));
        assert_eq!(found("Walk").unwrap(), Some(0));
        assert_eq!(found("Cape|Run").unwrap(), Some(2));
        assert!(found("Run").unwrap_err().to_string().contains("there is no take \"Run\""));
    }
}
