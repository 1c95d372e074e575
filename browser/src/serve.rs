//! Serves the page to browsers on this machine (ループバック).

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;

/// Answers requests until the program is ended.
pub(super) fn serve(page: &Path, port: u16) -> Result<(), String> {
    let text = fs::read(page).map_err(|error| format!("{}: {error}", page.display()))?;
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    let listener = listener.map_err(|error| format!("port {port}: {error}"))?;
    let at = listener.local_addr().map_err(|error| error.to_string())?;
    println!("http://{at}/");
    for asked in listener.incoming().flatten() {
        // A client that hangs up early is no error.
        drop(answer(asked, &text));
    }
    Ok(())
}

/// Answers a request with the page, or with 404 for any other path.
fn answer(mut asked: TcpStream, page: &[u8]) -> std::io::Result<()> {
    let mut lines = BufReader::new(asked.try_clone()?).lines();
    let first = lines.next().transpose()?.unwrap_or_default();
    while lines.next().transpose()?.is_some_and(|line| !line.is_empty()) {}
    let (status, body) = match first.split(' ').nth(1) {
        Some("/" | "/index.html") => ("200 OK", page),
        _ => ("404 Not Found", &b""[..]),
    };
    write!(
        asked,
        "HTTP/1.1 {status}\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        body.len()
    )?;
    asked.write_all(body)
}
