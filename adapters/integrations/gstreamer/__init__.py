"""GStreamer, a framework of elements and pads for media, behind the Python door: a real framework, not made for UCM."""
