"""The states of a contact point as files count them, with the colours of every picture."""

# (value in files, name, colour): distinct in hue and in lightness, for colour-blind eyes and grey print
STATES = [
    (0, "stick", "#12355b"),
    (1, "positive slip", "#f4a259"),
    (2, "negative slip", "#b23a6f"),
    (3, "separated", "#e9ecef"),
    (4, "slip in two directions", "#5b9279"),
]
