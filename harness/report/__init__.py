"""What a run leaves behind for people and machines: HTML, JSON, JUnit, and a summary for the terminal.

Everything a framework said is foreign text here; ``foreign`` is the one gate through which it passes.
"""
